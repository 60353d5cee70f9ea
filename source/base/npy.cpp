#include "base/npy.h"

#include "base/error.h"
#include "base/file.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

namespace strandlab {
namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr uint64_t longest_header = 65536;

/// "(3, 4, 4)" or "(3,)"; the first dimension may be a word.
std::string tuple_text(std::string_view first, std::span<const uint64_t> rest) {
    std::string text = fmt::format("({},", first);
    for (size_t i = 0; i < rest.size(); ++i)
        text += fmt::format(" {}{}", rest[i], i + 1 < rest.size() ? "," : "");
    text += ')';
    return text;
}

std::string tuple_text(std::span<const uint64_t> shape) {
    return shape.empty() ? "()" : tuple_text(std::to_string(shape[0]), shape.subspan(1));
}

/// Reads the Python dictionary of a header: exactly the keys descr, fortran_order and shape.
class HeaderParser {
  public:
    HeaderParser(const ByteSource& source, std::string_view text, uint64_t offset)
        : source_(source), text_(text), offset_(offset) {}

    void parse(NpyHeader& header) {
        expect('{');
        while (!accept('}')) {
            const std::string key = quoted();
            expect(':');
            parse_value(key, header);
            if (accept(',')) continue;
            expect('}');
            break;
        }
        skip_spaces();
        if (at_ != text_.size()) fail_here("nothing but spaces after '}'");
        for (const auto& [seen, key] :
             {std::pair(descr_, "descr"), {order_, "fortran_order"}, {shape_, "shape"}})
            if (!seen) fail(ExitCode::bad_input, "{}: the .npy header has no key '{}'", source_.name(), key);
    }

  private:
    [[noreturn]] void fail_here(std::string_view expected) const {
        const std::string found = at_ < text_.size()
                                      ? fmt::format("byte 0x{:02x}", static_cast<unsigned char>(text_[at_]))
                                      : "its end";
        fail(ExitCode::bad_input, "{}: damaged .npy header at offset {}: found {}, expected {}",
             source_.name(), offset_ + at_, found, expected);
    }

    void skip_spaces() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    }

    bool accept(char c) {
        skip_spaces();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    void expect(char c) {
        if (!accept(c)) fail_here(fmt::format("'{}'", c));
    }

    bool accept_word(std::string_view word) {
        skip_spaces();
        if (text_.substr(at_, word.size()) != word) return false;
        at_ += word.size();
        return true;
    }

    std::string quoted() {
        const char quote = accept('\'') ? '\'' : '"';
        if (quote == '"') expect('"');
        const size_t end = text_.find(quote, at_);
        if (end == std::string_view::npos) fail_here("a closing quote");
        std::string word;
        for (; at_ < end; ++at_) {
            if (text_[at_] < ' ' || text_[at_] > '~') fail_here("a plain word");
            word += text_[at_];
        }
        ++at_;
        return word;
    }

    uint64_t number() {
        skip_spaces();
        uint64_t value = 0;
        const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (error == std::errc::result_out_of_range) fail_here("a dimension below 2^64");
        if (error != std::errc()) fail_here("a whole number");
        at_ = static_cast<size_t>(end - text_.data());
        return value;
    }

    void parse_shape(std::vector<uint64_t>& shape) {
        expect('(');
        bool comma = true;
        while (!accept(')')) {
            if (!comma) fail_here("',' or ')'");
            if (shape.size() == 32) fail_here("at most 32 dimensions");
            shape.push_back(number());
            comma = accept(',');
        }
        if (shape.size() == 1 && !comma) fail_here("',' after a single dimension");
    }

    void parse_value(const std::string& key, NpyHeader& header) {
        bool* seen = key == "descr"           ? &descr_
                     : key == "fortran_order" ? &order_
                     : key == "shape"         ? &shape_
                                              : nullptr;
        if (!seen || *seen)
            fail(ExitCode::bad_input, "{}: the .npy header has the {} key '{}'", source_.name(),
                 seen ? "repeated" : "unknown", key);
        *seen = true;
        if (seen == &shape_) return parse_shape(header.shape);
        if (seen == &order_) {
            if (accept_word("False")) return;
            if (!accept_word("True")) fail_here("True or False");
            fail(ExitCode::bad_input,
                 "{}: 'fortran_order' is True, only C order is read: save numpy.ascontiguousarray(a)",
                 source_.name());
        }
        skip_spaces();
        if (at_ < text_.size() && text_[at_] == '[')
            fail(ExitCode::bad_input, "{}: 'descr' is a structured type, only plain numbers are read",
                 source_.name());
        header.dtype = quoted();
    }

    const ByteSource& source_;
    std::string_view text_;
    uint64_t offset_;
    size_t at_ = 0;
    bool descr_ = false, order_ = false, shape_ = false;
};

std::optional<uint64_t> product(uint64_t a, uint64_t b) {
    if (b != 0 && a > std::numeric_limits<uint64_t>::max() / b) return std::nullopt;
    return a * b;
}

}  // namespace

uint64_t NpyItem::bytes() const {
    assert(dtype == "<f4" || dtype == "<i4" || dtype == "<u4" || dtype == "<f8");
    uint64_t bytes = dtype == "<f8" ? 8 : 4;
    for (const uint64_t n : shape) bytes *= n;
    return bytes;
}

NpyHeader read_npy_header(const ByteSource& source) {
    char start[8] = {};
    if (source.size() >= sizeof(start)) source.read(0, start, sizeof(start), "magic");
    if (std::string_view(start, magic.size()) != magic)
        fail(ExitCode::bad_input, "{}: not a .npy file (it does not begin with \\x93NUMPY)", source.name());
    const auto version = static_cast<unsigned char>(start[6]), minor = static_cast<unsigned char>(start[7]);
    if (version < 1 || version > 3 || minor != 0)
        fail(ExitCode::bad_input, "{}: .npy version {}.{} at offset 6 is not 1.0, 2.0 or 3.0", source.name(),
             version, minor);
    const uint64_t begin = version == 1 ? 10 : 12;
    const uint64_t length = version == 1 ? source.value<uint16_t>(8, "header length")
                                         : source.value<uint32_t>(8, "header length");
    if (length > longest_header)
        fail(ExitCode::bad_input, "{}: header length {} at offset 8 is above {}", source.name(), length,
             longest_header);
    const std::vector<char> text = source.array<char>(begin, length, "header");
    NpyHeader header;
    header.data_offset = begin + length;
    HeaderParser(source, {text.data(), text.size()}, begin).parse(header);
    return header;
}

NpyHeader require_npy(const ByteSource& source, const NpyItem& item) {
    NpyHeader header = read_npy_header(source);
    if (header.dtype != item.dtype)
        fail(ExitCode::bad_input, "{}: 'descr' is '{}', need '{}': save a.astype('{}')", source.name(),
             header.dtype, item.dtype, item.dtype);
    if (header.shape.empty() ||
        !std::equal(header.shape.begin() + 1, header.shape.end(), item.shape.begin(), item.shape.end()))
        fail(ExitCode::bad_input, "{}: 'shape' is {}, need {}", source.name(), tuple_text(header.shape),
             tuple_text("N", item.shape));
    const std::optional<uint64_t> bytes = product(header.shape[0], item.bytes());
    const uint64_t present = source.size() - header.data_offset;
    if (!bytes || *bytes != present)
        fail(ExitCode::bad_input, "{}: 'shape' {} needs {} bytes of data at offset {}, the file has {}",
             source.name(), tuple_text(header.shape), bytes ? std::to_string(*bytes) : "more than 2^64",
             header.data_offset, present);
    return header;
}

void write_npy(const std::string& path, const NpyItem& item, const void* data, uint64_t count) {
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", item.dtype,
                                     tuple_text(std::to_string(count), item.shape));
    const size_t unpadded = magic.size() + 4 + header.size() + 1;
    header.append((64 - unpadded % 64) % 64, ' ').append("\n");
    const auto length = static_cast<uint16_t>(header.size());
    FileWriter file(path);
    file.write(magic);
    file.write("\x01\x00", 2);
    file.write(&length, sizeof(length));
    file.write(header);
    file.write(data, count * item.bytes());
    file.commit();
}

}  // namespace strandlab
