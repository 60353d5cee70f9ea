// Horizontal bars of several parts, one bar a row.
#pragma once

#include "report/html/drawing.h"

#include <cstddef>
#include <string>
#include <vector>

namespace strandlab {

/// A part that every bar may have: the class of its colour, and its name in the key.
struct BarPart {
    std::string style, name;
};

/// A bar: the row that it stands for, and the size of each part.
struct StackedBar {
    size_t row = 0;
    std::string label;
    std::vector<double> sizes;
    double figure = 0;    // written at its end; bars come in the order of their figures
    bool chosen = false;  // drawn even where there are too many bars

    double total() const;
};

/// Bars whose sizes are not all finite and at least 0 are left out; where there are more than most_bars, so
/// are those that are not chosen, and the axis says so.
struct StackedBars {
    std::string title, axis_title;
    std::vector<BarPart> parts;
    std::vector<StackedBar> bars;

    static constexpr size_t most_bars = 32;

    bool has_bars() const;
    Drawing draw() const;
};

}  // namespace strandlab
