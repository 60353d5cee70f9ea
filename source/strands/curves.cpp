#include "strands/curves.h"

#include "base/hash.h"

#include <algorithm>

namespace strandlab {

uint32_t Curves::strand_of(uint32_t curve) const {
    const auto after = std::upper_bound(strands.begin(), strands.end(), curve,
                                        [](uint32_t c, const StrandRange& s) { return c < s.first; });
    return static_cast<uint32_t>(after - strands.begin()) - 1;
}

bool Curves::begins_strand(uint32_t curve) const { return strands[strand_of(curve)].first == curve; }

bool Curves::ends_strand(uint32_t curve) const {
    const StrandRange strand = strands[strand_of(curve)];
    return strand.first + strand.count - 1 == curve;
}

Curves with_scaled_radii(const Curves& curves, float scale) {
    Curves scaled = curves;
    for (Curve& curve : scaled.curves)
        for (glm::vec4& point : curve) point.w *= scale;
    return scaled;
}

uint64_t hash(const Curves& curves) {
    return Hash()
        .add(std::span<const Curve>(curves.curves))
        .add(std::span<const StrandRange>(curves.strands))
        .value();
}

}  // namespace strandlab
