#include "report/lod_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

constexpr double left = 60, right = 590, width = 760;

/// A rectangle of the chart with its vertical scale.
struct Panel {
    double top, bottom, low, high;  // values at bottom and top

    double y(double value) const {
        const double clamped = std::clamp(value, low, high);
        return bottom + (top - bottom) * (clamped - low) / (high - low);
    }
};

struct Line {
    const char* name;
    const char* colour;
    double (*value)(const LodPoint&);
};

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

class Chart {
  public:
    explicit Chart(const std::vector<LodPoint>& points) : points_(points) {}

    double x(double distance) const {
        const double last = std::log2(points_.back().distance), first = std::log2(points_.front().distance);
        return last > first ? left + (right - left) * (std::log2(distance) - first) / (last - first) : left;
    }

    void text(double at_x, double at_y, const std::string& words, const char* anchor = "start",
              const char* colour = "#333") {
        svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
                            at_x, at_y, anchor, colour, words);
    }

    void grid(const Panel& panel, const std::vector<double>& ticks, double (*label)(double),
              const char* unit) {
        for (const double tick : ticks) {
            const double y = panel.y(tick);
            svg_ += fmt::format("<path d=\"M{} {:.1f}H{}\" stroke=\"#ddd\"/>\n", left, y, right);
            text(left - 6, y + 4, fmt::format("{:.4g}{}", label(tick), unit), "end");
        }
        for (const LodPoint& point : points_)
            svg_ += fmt::format("<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"#eee\"/>\n", x(point.distance),
                                panel.top, panel.bottom);
    }

    void line(const Panel& panel, const Line& line, size_t row) {
        std::string path;
        for (const LodPoint& point : points_)
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(point.distance),
                                panel.y(line.value(point)));
        svg_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path,
                            line.colour);
        for (const LodPoint& point : points_)
            svg_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n",
                                x(point.distance), panel.y(line.value(point)), line.colour);
        text(right + 12, panel.top + 14 + 18 * double(row), line.name, "start", line.colour);
    }

    const std::string& svg() const { return svg_; }

  private:
    const std::vector<LodPoint>& points_;
    std::string svg_;
};

constexpr Line errors[] = {
    {"covered area", "#c0392b", [](const LodPoint& p) { return 100 * p.coverage_bias; }},
    {"pixel coverage, rms", "#e08e0b", [](const LodPoint& p) { return 100 * p.coverage_rms; }},
    {"transmittance", "#2471a3", [](const LodPoint& p) { return 100 * p.transmittance_bias; }},
};

constexpr Line costs[] = {
    {"detail L", "#888888", [](const LodPoint& p) { return std::log2(p.detail); }},
    {"bytes", "#1e8449", [](const LodPoint& p) { return std::log2(p.bytes); }},
    {"build time", "#7d3c98", [](const LodPoint& p) { return std::log2(p.build); }},
    {"trace time", "#16a085", [](const LodPoint& p) { return std::log2(p.trace); }},
};

/// The smallest of a few round limits that holds every error.
double error_limit(const std::vector<LodPoint>& points) {
    double largest = 0;
    for (const LodPoint& point : points)
        for (const Line& line : errors) largest = std::max(largest, std::abs(line.value(point)));
    for (const double limit : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0})
        if (largest <= limit) return limit;
    return 100;
}

}  // namespace

std::string lod_chart(const std::string& title, const std::vector<LodPoint>& points) {
    if (points.empty()) return {};
    Chart chart(points);
    const double limit = error_limit(points);
    const Panel top{50, 230, -limit, limit};
    double least = -1, most = 1;
    for (const LodPoint& point : points)
        for (const Line& line : costs) {
            if (!std::isfinite(line.value(point))) continue;
            least = std::min(least, std::floor(line.value(point)));
            most = std::max(most, std::ceil(line.value(point)));
        }
    const Panel bottom{270, 470, least, most};
    chart.text(left, 28, escaped(title));
    chart.grid(
        top, {-limit, -limit / 2, 0, limit / 2, limit}, [](double v) { return v; }, " %");
    std::vector<double> powers;
    for (double p = least; p <= most; p += std::max(1.0, std::round((most - least) / 6))) powers.push_back(p);
    chart.grid(
        bottom, powers, [](double v) { return std::exp2(v); }, "");
    for (size_t i = 0; i < std::size(errors); ++i) chart.line(top, errors[i], i);
    for (size_t i = 0; i < std::size(costs); ++i) chart.line(bottom, costs[i], i);
    for (const LodPoint& point : points)
        chart.text(chart.x(point.distance), 490, fmt::format("{:g}x", point.distance), "middle");
    chart.text(0.5 * (left + right), 510, "distance", "middle");
    chart.text(right + 12, 250, "above: error, below: of full detail");
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"520\" viewBox=\"0 0 {0:g} 520\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n{1}</svg>\n",
        width + 40, chart.svg());
}

}  // namespace strandlab
