#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "report/html/markup.h"
#include "report/html/sections.h"
#include "report/result_json.h"
#include "report/row_fields.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <unordered_map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_file = 32u << 20;

/// The pictures of a page, each file once.
class Pictures {
  public:
    /// The number of a picture; nothing, with a warning, where the file is no PNG file that can be read.
    std::optional<size_t> number_of(const std::string& path) {
        const auto [found, is_new] = numbers_.emplace(path, uris_.size());
        if (!is_new) return found->second;
        const std::optional<std::string> bytes = read(path);
        if (!bytes) {
            found->second = std::nullopt;
            return std::nullopt;
        }
        uris_.push_back(data_uri("image/png", *bytes));
        return found->second;
    }
    Json uris() const { return uris_; }

  private:
    static std::optional<std::string> read(const std::string& path) {
        std::error_code error;
        const auto size = std::filesystem::file_size(path, error);
        if (error || size > largest_file) {
            warn("{}: {}; the report goes without this picture", path,
                 error ? error.message() : "over 32 MiB");
            return std::nullopt;
        }
        try {
            std::string bytes = read_file(path);
            if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return bytes;
            warn("{}: is no PNG file; the report goes without this picture", path);
        } catch (const Error& problem) {
            warn("{}; the report goes without this picture", problem.what());
        }
        return std::nullopt;
    }

    std::unordered_map<std::string, std::optional<size_t>> numbers_;
    std::vector<std::string> uris_;
};

/// "error_map" as people read it.
std::string kind_name(std::string key) {
    for (char& c : key)
        if (c == '_') c = ' ';
    return key;
}

}  // namespace

std::string picture_section(const PageData& data) {
    Pictures pictures;
    Json list = Json::array();
    for (const RowGroup& group : data.groups)
        for (const size_t i : group.all()) {
            const Json& row = data.results.rows[i];
            const Json* images = field_at(row, "images");
            if (!images || !images->is_object()) continue;
            for (const auto& [key, value] : images->items()) {
                if (!value.is_string()) continue;
                const auto path = std::filesystem::path(text_at(row, "folder")) / value.get<std::string>();
                if (const auto number = pictures.number_of(path.string()))
                    list.push_back({{"row", i},
                                    {"group", group.title()},
                                    {"label", row_label(row)},
                                    {"kind", kind_name(key)},
                                    {"picture", *number}});
            }
        }
    if (list.empty()) return "";
    return to_line({{"list", std::move(list)}, {"uris", pictures.uris()}});
}

}  // namespace strandlab
