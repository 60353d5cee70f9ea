// A program of somebody else's: builds the leaves of one curve with every primitive there is.
#include "base/build_info.h"
#include "primitives/primitive.h"

#include <cstdio>

int main() {
    using namespace strandlab;
    Curves curves;
    curves.curves.push_back({glm::vec4(0, 0, 0, 0.1f), glm::vec4(1, 0, 0, 0.1f), glm::vec4(2, 1, 0, 0.1f),
                             glm::vec4(3, 1, 0, 0.05f)});
    curves.strands.push_back({0, 1});
    std::printf("strandlab %s\n", std::string(build_info().version).c_str());
    if (primitives().empty()) return 1;
    for (const Primitive& primitive : primitives()) {
        const Geometry geometry = primitive.build(curves, parse_primitive(primitive.name).options);
        std::printf("%s: %zu leaves\n", primitive.name.c_str(), geometry.leaf_count());
        if (geometry.leaf_count() == 0) return 1;
    }
    return 0;
}
