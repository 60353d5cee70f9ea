#include "report/file_name.h"

#include <cctype>
#include <set>

namespace strandlab {

std::string file_name_of(std::string_view text) {
    std::string name;
    for (const char c : text) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '=';
        if (plain)
            name += c;
        else if (!name.empty() && name.back() != '_')
            name += '_';
    }
    if (name.size() > 60) name.resize(60);
    while (name.ends_with('_')) name.pop_back();
    return name.empty() ? "unnamed" : name;
}

std::vector<std::string> file_names_of(std::span<const std::string> texts) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const std::string& text : texts) {
        const std::string name = file_name_of(text);
        names.push_back(name);
        for (int i = 2; !taken.insert(names.back()).second; ++i)
            names.back() = name + "-" + std::to_string(i);
    }
    return names;
}

}  // namespace strandlab
