#include "scene/obj_file.h"

#include "base/error.h"
#include "base/text.h"
#include "strands/strands.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace strandlab {
namespace {

/// Words of a line, at most as many as asked for matter to callers.
std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    line = line.substr(0, line.find('#'));
    for (size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
        const size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

class ObjReader {
  public:
    explicit ObjReader(const std::string& name) : name_(name) {}

    void read_line(std::string_view line) {
        ++line_;
        const std::vector<std::string_view> words = words_of(line);
        if (words.empty()) return;
        if (words[0] == "v") read_vertex(words);
        if (words[0] == "f") read_face(words);
    }

    std::vector<Triangle> triangles;

  private:
    template <class... Args>
    [[noreturn]] void reject(fmt::format_string<Args...> format, Args&&... args) const {
        fail(ExitCode::bad_input, "{}: line {}: {}", name_, line_,
             fmt::format(format, std::forward<Args>(args)...));
    }

    void read_vertex(const std::vector<std::string_view>& words) {
        if (words.size() < 4) reject("a vertex needs three numbers, not {}", words.size() - 1);
        glm::vec3 p;
        for (int i = 0; i < 3; ++i) {
            const auto x = to_number(words[i + 1]);
            if (!x || !(std::abs(*x) <= double(largest_coordinate)))
                reject("'{}' is not a number up to {:g}", one_line(words[i + 1].substr(0, 40)),
                       largest_coordinate);
            p[i] = static_cast<float>(*x);
        }
        vertices_.push_back(p);
    }

    const glm::vec3& vertex(std::string_view word) const {
        const auto n = to_number(word.substr(0, word.find('/')));
        const double count = double(vertices_.size()), index = n && *n < 0 ? count + *n : n.value_or(0) - 1;
        if (!n || !(index >= 0 && index < count) || *n != std::floor(*n))
            reject("'{}' is no vertex: there are {} so far", one_line(word.substr(0, 40)), vertices_.size());
        return vertices_[static_cast<size_t>(index)];
    }

    void read_face(const std::vector<std::string_view>& words) {
        if (words.size() < 4) reject("a face needs three vertices, not {}", words.size() - 1);
        for (size_t i = 3; i < words.size(); ++i)
            triangles.push_back({vertex(words[1]), vertex(words[i - 1]), vertex(words[i])});
    }

    std::string name_;
    size_t line_ = 0;
    std::vector<glm::vec3> vertices_;
};

}  // namespace

std::vector<Triangle> load_obj(const ByteSource& source) {
    std::string text(source.size(), '\0');
    source.read(0, text.data(), text.size(), "OBJ file");
    ObjReader reader(source.name());
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        reader.read_line(std::string_view(text).substr(at, end - at));
        at = end + 1;
    }
    if (reader.triangles.empty())
        fail(ExitCode::bad_input, "{}: no face in it: no OBJ file of triangles", source.name());
    return std::move(reader.triangles);
}

}  // namespace strandlab
