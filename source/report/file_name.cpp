#include "report/file_name.h"

#include <cctype>

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

}  // namespace strandlab
