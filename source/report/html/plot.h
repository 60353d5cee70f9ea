// The plane that points and lines are drawn in.
#pragma once

#include "report/html/axis.h"
#include "report/html/drawing.h"

#include <span>
#include <string>

namespace strandlab {

/// A rectangle of a drawing, in pixels.
struct PlotArea {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// Grid lines with their figures: below for x, on the left for y; y's figures are its values times y_unit
/// (100: per cent).
void draw_grid(Drawing& drawing, const PlotArea& area, const LogAxis& x, const LogAxis& y, double y_unit = 1);

/// The two axes and their titles.
void draw_axes(Drawing& drawing, const PlotArea& area, const std::string& x_title,
               const std::string& y_title);

/// A point of a line, in pixels.
struct LinePoint {
    double x = 0, y = 0;
};

/// A line with a small mark at each point, in the colour of a series; it stands for a row.
void draw_line(Drawing& drawing, size_t series, std::span<const LinePoint> points, size_t row);

}  // namespace strandlab
