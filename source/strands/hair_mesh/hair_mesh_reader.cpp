// The text form of hair meshes: one record a line, '#' begins a comment.
#include "base/error.h"
#include "base/text.h"
#include "strands/hair_mesh/hair_mesh.h"
#include "strands/hair_mesh/parameters.h"
#include "strands/hair_mesh/units.h"

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

constexpr double largest_count = 1e7;
constexpr double largest_metres = 1e3;  // float32 strands keep 0.1 mm there

class Reader {
  public:
    explicit Reader(const ByteSource& source) : text_(source.size(), '\0') {
        source.read(0, text_.data(), text_.size(), "hair mesh");
        lines_.file = source.name();
    }

    HairMesh read() {
        read_first_line();
        bool more = next_line();
        while (more && !is_block(words_[0])) {
            read_key();
            more = next_line();
        }
        if (!more) words_.clear();
        for (const char* key : {"name", "vertices", "layers", "faces"})
            if (std::find(keys_.begin(), keys_.end(), key) == keys_.end())
                fail(ExitCode::bad_input, "{}: line {}: key '{}' is missing before the blocks", lines_.file,
                     line_, key);
        read_uv();
        read_faces();
        for (uint32_t layer = 0; layer <= mesh_.layer_count; ++layer) read_layer(layer);
        if (next_line()) reject("text after the last layer: '{}'", shown(words_[0]));
        check_hair_mesh(mesh_, lines_);
        return std::move(mesh_);
    }

  private:
    template <class... Args>
    [[noreturn]] void reject(fmt::format_string<Args...> format, Args&&... args) const {
        fail(ExitCode::bad_input, "{}: line {}: {}", lines_.file, line_,
             fmt::format(format, std::forward<Args>(args)...));
    }

    static std::string shown(std::string_view word) { return one_line(word.substr(0, 40)); }

    std::string_view raw_line() {
        const size_t end = std::min(text_.find('\n', offset_), text_.size());
        std::string_view line(text_.data() + offset_, end - offset_);
        offset_ = end + 1;
        ++line_;
        // All of them, or a comment would lose one with every reading.
        while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        return line;
    }

    /// Splits the next line that holds anything; false at the end of the file.
    bool next_line() {
        while (offset_ < text_.size()) {
            std::string_view line = raw_line();
            line = line.substr(0, line.find('#'));
            words_.clear();
            for (size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string_view::npos;) {
                const size_t end = std::min(line.find_first_of(" \t", at), line.size());
                words_.push_back(line.substr(at, end - at));
                at = end;
            }
            if (!words_.empty()) return true;
        }
        return false;
    }

    void require_line(std::string_view what) {
        if (!next_line()) reject("the file ends where {} is expected: it is truncated", what);
    }

    void read_first_line() {
        if (text_.empty() || raw_line() != "strandlab hairmesh 1") {
            const std::string_view line = std::string_view(text_).substr(0, text_.find('\n'));
            line_ = 1;
            if (line.substr(0, 18) == "strandlab hairmesh")
                reject("'{}': only version 1 can be read", shown(line));
            reject("'{}' is not 'strandlab hairmesh 1': no hair mesh", shown(line));
        }
        while (offset_ < text_.size() && text_[offset_] == '#') mesh_.comments.emplace_back(raw_line());
    }

    static bool is_block(std::string_view word) { return word == "uv"; }

    void read_key() {
        const std::string key(words_[0]);
        if (key == "style") return read_style();
        static const std::vector<std::string> known{"name",  "unit",   "vertices", "layers",
                                                    "faces", "frames", "style"};
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            const auto guess = nearest(key.substr(0, 40), known);
            reject("no key '{}'{}; there are {}, and the block 'uv' after them", shown(key),
                   guess ? fmt::format(", did you mean '{}'?", *guess) : "", list_of(known, "and"));
        }
        if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) reject("key '{}' stands twice", key);
        if (words_.size() != 2) reject("key '{}' takes one value, not {}", key, words_.size() - 1);
        keys_.push_back(key);
        const std::string_view value = words_[1];
        if (key == "name") mesh_.name = one_line(value.substr(0, 100));
        if (key == "vertices") mesh_.vertex_count = count(value, 3);
        if (key == "layers") mesh_.layer_count = count(value, 1);
        if (key == "faces") face_count_ = count(value, 1);
        if (key == "unit") {
            if (!unit_named(value)) reject("unit '{}' is not m, cm or mm", shown(value));
            mesh_.unit_name = value;
        }
        if (key == "frames") {
            if (value != "root" && value != "layer") reject("frames '{}' is not root or layer", shown(value));
            mesh_.frames = value == "root" ? FrameRule::root : FrameRule::layer;
        }
    }

    void read_style() {
        for (size_t i = 1; i < words_.size(); ++i) {
            const std::string_view pair = words_[i];
            const size_t equals = pair.find('=');
            if (equals == std::string_view::npos) reject("style: '{}' is not key=value", shown(pair));
            const std::string key(pair.substr(0, equals));
            if (is_of_caller(key)) reject("style: '{}' is for who asks for strands, not for the file", key);
            if (std::find(styled_.begin(), styled_.end(), key) != styled_.end())
                reject("style: key '{}' stands twice", shown(key));
            styled_.push_back(key);
            try {
                mesh_.style.set("style", hair_mesh_parameters(), key, pair.substr(equals + 1));
            } catch (const Error& error) {
                reject("{}", one_line(error.what()));
            }
        }
    }

    uint32_t count(std::string_view word, double low) const {
        const auto n = to_number(word);
        if (!n || !(*n >= low && *n <= largest_count) || *n != std::floor(*n))
            reject("{} {} is not a whole number from {} to {}", words_[0], shown(word), low, largest_count);
        return static_cast<uint32_t>(*n);
    }

    double number(size_t word) const {
        const auto x = to_number(words_[word]);
        const double limit = largest_metres / mesh_.unit();
        if (!x || !(std::abs(*x) <= limit))
            reject("'{}' is not a number from {} to {} (1 km)", shown(words_[word]), -limit, limit);
        return *x;
    }

    void require_header(std::string_view block) {
        if (words_.size() != 1 || words_[0] != block)
            reject("'{}' where '{}' begins", shown(words_[0]), block);
    }

    void read_uv() {
        if (words_.empty() || words_[0] != "uv")
            reject("the file ends where block 'uv' is expected: it is truncated");
        require_header("uv");
        for (uint32_t i = 0; i < mesh_.vertex_count; ++i) {
            require_line(fmt::format("uv of vertex {} of {}", i, mesh_.vertex_count));
            if (words_.size() != 2) reject("uv of vertex {} has {} numbers, not 2", i, words_.size());
            mesh_.uv.emplace_back(number(0), number(1));
            lines_.uv.push_back(line_);
        }
    }

    void read_faces() {
        require_line("block 'faces'");
        require_header("faces");
        for (uint32_t i = 0; i < face_count_; ++i) {
            require_line(fmt::format("face {} of {}", i, face_count_));
            HairMeshFace face;
            if (words_[0] != "q" && words_[0] != "t") reject("face '{}' is not q or t", shown(words_[0]));
            face.corners = words_[0] == "q" ? 4 : 3;
            if (words_.size() != face.corners + 1)
                reject("face {} has {} vertices, not {}", words_[0], words_.size() - 1, face.corners);
            for (uint32_t k = 0; k < face.corners; ++k) {
                const auto n = to_number(words_[k + 1]);
                if (!n || !(*n >= 0 && *n < mesh_.vertex_count) || *n != std::floor(*n))
                    reject("vertex {} is not a whole number from 0 to {}", shown(words_[k + 1]),
                           mesh_.vertex_count - 1);
                face.vertex[k] = static_cast<uint32_t>(*n);
            }
            mesh_.faces.push_back(face);
            lines_.faces.push_back(line_);
        }
    }

    void read_layer(uint32_t layer) {
        require_line(fmt::format("layer {} of {}", layer, mesh_.layer_count));
        if (words_.size() != 2 || words_[0] != "layer" || to_number(words_[1]) != layer)
            reject("'{}{}' where 'layer {}' begins", shown(words_[0]),
                   words_.size() > 1 ? " " + shown(words_[1]) : "", layer);
        for (uint32_t i = 0; i < mesh_.vertex_count; ++i) {
            require_line(fmt::format("vertex {} of {} of layer {}", i, mesh_.vertex_count, layer));
            if (layer == 0 && i == 0) has_w_ = words_.size() == 4;
            if (words_.size() != (has_w_ ? 4u : 3u))
                reject("vertex {} of layer {} has {} numbers, not {} as the first one", i, layer,
                       words_.size(), has_w_ ? 4 : 3);
            mesh_.positions.emplace_back(number(0), number(1), number(2));
            if (has_w_) mesh_.w.push_back(number(3));
            lines_.positions.push_back(line_);
        }
    }

    std::string text_;
    size_t offset_ = 0, line_ = 0;
    std::vector<std::string_view> words_;
    std::vector<std::string> keys_, styled_;
    uint32_t face_count_ = 0;
    bool has_w_ = false;
    HairMesh mesh_;
    HairMeshLines lines_;
};

}  // namespace

HairMesh read_hair_mesh(const ByteSource& source) { return Reader(source).read(); }

}  // namespace strandlab
