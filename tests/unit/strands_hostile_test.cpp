// Thousands of damaged files under every reader: each is read or refused in one line, never anything else.
#include "base/random.h"
#include "fuzz/load_bytes.h"
#include "fuzz/samples.h"

#include <gtest/gtest.h>

#include <cstring>

namespace strandlab {
namespace {

/// Loads as the sample's own format and as every other; counts what was accepted.
size_t load_everywhere(const std::string& bytes, Basis basis) {
    static const std::string curves = samples::npy_curves(4);
    size_t accepted = 0;
    for (const ModelFormat& format : model_formats())
        accepted += load_bytes(format.extension, samples::as_bytes(bytes), basis);
    const ByteSource strands = ByteSource::from_memory("input strands", samples::as_bytes(bytes));
    return accepted + load_bytes(".npy", samples::as_bytes(curves), basis, &strands);
}

TEST(HostileFiles, SamplesThemselvesAreAccepted) {
    for (const samples::Sample& sample : samples::all())
        EXPECT_GE(load_everywhere(sample.bytes, Basis::centripetal), 1u) << sample.extension;
}

TEST(HostileFiles, EveryTruncationIsRefused) {
    for (const samples::Sample& sample : samples::all())
        for (size_t n = 0; n < sample.bytes.size(); ++n)
            EXPECT_FALSE(
                load_bytes(sample.extension, samples::as_bytes(sample.bytes.substr(0, n)), Basis::linear))
                << sample.extension << " cut to " << n;
}

TEST(HostileFiles, RandomBytesAndWordsNeverBreakAReader) {
    const uint32_t words[] = {0,          1,          2,          0x7FFFFFFF, 0x80000000,
                              0xFFFFFFFF, 0x7F800000, 0x7FC00000, 0xFF7FFFFF, 0x10000};
    const auto all = samples::all();
    for (uint64_t trial = 0; trial < 3000; ++trial) {
        Random random(20, 0, trial);
        std::string bytes = all[random.below(uint32_t(all.size()))].bytes;
        for (uint32_t i = 0, n = 1 + random.below(4); i < n; ++i) {
            const uint32_t at = random.below(uint32_t(bytes.size() - 3));
            if (random.below(2) == 0)
                bytes[at] = static_cast<char>(random.bits());
            else  // lying counts, offsets and special numbers, mostly where the headers have theirs
                std::memcpy(&bytes[random.below(4) ? std::min<size_t>(at & ~3u, 4 * random.below(40)) : at],
                            &words[random.below(std::size(words))], 4);
        }
        if (random.below(8) == 0) bytes.append(random.below(20), '\xff');
        EXPECT_NO_THROW(load_everywhere(bytes, static_cast<Basis>(random.below(4)))) << "trial " << trial;
    }
}

}  // namespace
}  // namespace strandlab
