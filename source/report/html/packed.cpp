#include "report/html/packed.h"

#include "report/html/markup.h"

#include <fmt/format.h>

#include <new>
#include <zlib.h>

namespace strandlab {

std::string packed(std::string_view text) {
    uLongf size = compressBound(static_cast<uLong>(text.size()));
    std::string bytes(size, '\0');
    const int status =
        compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
                  static_cast<uLong>(text.size()), Z_BEST_COMPRESSION);
    if (status != Z_OK) throw std::bad_alloc();  // the only way in which it can fail
    return base64({bytes.data(), size});
}

std::string data_element(const std::string& id, std::string_view json) {
    if (json.size() <= longest_plain_text)
        return fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>", id,
                           escape_script(json));
    return fmt::format("<script type=\"text/plain\" id=\"{}\" data-packed>{}</script>", id, packed(json));
}

std::string markup_or_packed(std::string_view markup) {
    if (markup.size() <= longest_plain_text) return std::string(markup);
    return fmt::format(
        "<noscript><p>So many charts are packed: they need scripts.</p></noscript>\n"
        "<script type=\"text/plain\" class=\"packed\">{}</script>\n",
        packed(markup));
}

}  // namespace strandlab
