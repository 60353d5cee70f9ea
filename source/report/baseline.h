// Result rows against those of an earlier run: what became slower, and what more wrong.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// One line each, naming case, figure and both values.
struct BaselineComparison {
    size_t rows = 0;   // that were compared
    size_t times = 0;  // of those whose times were
    std::vector<std::string> worse, better, notes;

    bool is_worse() const { return !worse.empty(); }
};

/// Compares each row with the one of the baseline that measured the same: of equal key; else of the same
/// device, model, ray set, resolution and primitive by their names (then what has changed counts as worse:
/// results of other curves or rays cannot be compared); else the only one whose primitive differs in
/// parameters alone.
///
/// Errors are compared exactly: rays and seed are the same, so any difference was made by the program. Times
/// are compared as ratios to the baseline primitive of their own run (which cancels what hits both alike),
/// or, with a note, as they are where the runs have none in common. A row is slower only if the whole of its
/// one-sided interval lies above `factor`, at a level that Holm's correction shares among all rows.
BaselineComparison compare_with_baseline(std::span<const nlohmann::ordered_json> rows,
                                         std::span<const nlohmann::ordered_json> baseline,
                                         double factor = 1.05);

std::string to_text(const BaselineComparison& comparison);

}  // namespace strandlab
