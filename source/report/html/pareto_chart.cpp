// Time or memory against error.
#include "report/html/charts.h"
#include "report/html/markup.h"
#include "report/html/plot.h"
#include "report/row_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

constexpr double width = 390, height = 320, left = 54, right = 374, bottom = 274;
/// Beside the logarithmic axis: what has no place on it. Within it: room for marks at its ends.
constexpr double band = 30, wide_band = 44, margin = 8;

/// A row as a point; x and y are pixels once it has been placed.
struct Point {
    size_t row = 0;
    double cost = 0, error = 0;
    std::optional<double> low, high;  // 95 % interval of the cost
    bool on_front = false;
    double x = 0, y = 0;
};

/// A taken part of the plot.
struct Box {
    double left, top, right, bottom;
    bool overlaps(const Box& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

class ParetoChart {
  public:
    ParetoChart(const ChartRows& data, const RowGroup& group, Cost cost, ErrorKind kind)
        : data_(data),
          group_(group),
          cost_(cost),
          kind_(kind),
          drawing_(
              width, height,
              fmt::format("{} against {}: {}", cost == Cost::time ? "Time" : "Memory",
                          kind == ErrorKind::distance ? "distance error" : "wrong rays", group.title())) {
        for (const size_t i : group.all()) add_point(i);
    }

    std::optional<Drawing> draw() {
        if (points_.empty()) return std::nullopt;
        top_ = draw_legend(drawing_, data_.rows, group_.all(), left, 14) + 2;
        place_points();
        draw_axes();
        draw_front();
        for (const Point& point : points_) draw_interval(point);
        draw_marks();
        draw_names();
        return drawing_;
    }

  private:
    void add_point(size_t i) {
        const Json& row = data_.rows[i];
        const RowError error = row_error(row);
        Point point;
        point.row = i;
        if (cost_ == Cost::time) {
            point.cost = row_time(row);
            point.low = number_at(row, "time.trace_ms.low");
            point.high = number_at(row, "time.trace_ms.high");
        } else {
            point.cost = number_or_nan(row, "memory.bytes_per_curve");
        }
        point.error = kind_ == ErrorKind::wrong ? 100 * error.wrong_share : error.ranking;
        const FrontMarks& marks = data_.marks[i];
        point.on_front = kind_ == ErrorKind::wrong
                             ? (cost_ == Cost::time ? marks.time_wrong : marks.memory_wrong)
                             : (cost_ == Cost::time ? marks.time_error : marks.memory_error);
        if (point.cost > 0 && std::isfinite(point.cost) && point.error >= 0) points_.push_back(point);
    }

    template <class Condition>
    bool any(Condition condition) const {
        return std::any_of(points_.begin(), points_.end(), condition);
    }

    void place_points() {
        std::vector<double> errors, costs;
        for (const Point& point : points_) {
            errors.push_back(point.error);
            costs.push_back(point.cost);
            if (point.high && cost_ == Cost::time) costs.push_back(*point.high);
        }
        has_zero_ = any([](const Point& p) { return p.error == 0; });
        has_infinite_ = any([](const Point& p) { return std::isinf(p.error); });
        plot_left_ = left + margin + (has_zero_ ? band : 0);
        plot_right_ = right - margin - (has_infinite_ ? wide_band + 16 : 0);
        x_.emplace(errors, plot_left_, plot_right_);
        y_.emplace(costs, bottom - margin, top_ + margin);
        for (Point& point : points_) {
            point.x = point.error == 0          ? left + band / 2
                      : std::isinf(point.error) ? right - wide_band / 2
                                                : x_->at(point.error);
            point.y = y_->at(point.cost);
        }
    }

    void draw_axes() {
        if (has_zero_) drawing_.rectangle("band", left, top_, band, bottom - top_);
        if (has_infinite_) drawing_.rectangle("band", right - wide_band, top_, wide_band, bottom - top_);
        const PlotArea area{left, top_, right, bottom};
        draw_grid(drawing_, area, *x_, *y_);
        if (has_zero_) drawing_.text("tick middle", left + band / 2, bottom + 15, "0");
        if (has_infinite_) {
            drawing_.text("tick middle", right - wide_band / 2, bottom + 15, "> 1 %");
            drawing_.text("tick middle", right - wide_band / 2, bottom + 27, "wrong");
        }
        draw_limit(kind_ == ErrorKind::wrong ? 1 : 0.1);
        strandlab::draw_axes(
            drawing_, area,
            kind_ == ErrorKind::wrong ? "wrong, % of the rays that meet hair"
                                      : "|dt| that 99 % of hits stay within, radii",
            cost_ == Cost::time ? "trace time, ms" : "memory while tracing, bytes per curve");
    }

    /// The error that summaries ask for.
    void draw_limit(double limit) {
        if (limit <= x_->low() || limit >= x_->high()) return;
        drawing_.line("limit", x_->at(limit), top_, x_->at(limit), bottom);
    }

    /// A stair: what lies right of it or above is beaten by a row on it.
    void draw_front() {
        std::vector<Point> front;
        for (const Point& point : points_)
            if (point.on_front) front.push_back(point);
        if (front.size() < 2) return;
        std::sort(front.begin(), front.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
        std::string data = fmt::format("M{} {}", coordinate(front[0].x), coordinate(front[0].y));
        for (size_t i = 1; i < front.size(); ++i)
            data += fmt::format("H{}V{}", coordinate(front[i].x), coordinate(front[i].y));
        drawing_.path("front", data);
    }

    void draw_interval(const Point& point) {
        if (!point.low || !point.high || !(*point.low > 0)) return;
        const double low = std::min(bottom, y_->at(*point.low)), high = std::max(top_, y_->at(*point.high));
        if (low - high > 8)
            drawing_.line(fmt::format("interval s{}", series_of(data_.rows[point.row])), point.x, low,
                          point.x, high);
    }

    /// Those of the front above the others, each series together.
    void draw_marks() {
        const auto place = [&](const Point& p) {
            return std::pair(p.on_front, series_of(data_.rows[p.row]));
        };
        std::vector<Point> ordered = points_;
        std::stable_sort(ordered.begin(), ordered.end(),
                         [&](const Point& a, const Point& b) { return place(a) < place(b); });
        for (const Point& point : ordered)
            drawing_.mark(point.on_front ? "p f" : "p", series_of(data_.rows[point.row]), point.x, point.y,
                          point.row);
    }

    /// Names of the front's rows where there is room.
    void draw_names() {
        std::vector<Box> taken;
        for (const Point& point : points_)
            taken.push_back({point.x - 5, point.y - 5, point.x + 5, point.y + 5});
        for (const Point& point : points_) {
            if (!point.on_front) continue;
            const std::string name = shortened(text_at(data_.rows[point.row], "primitive.label"), 24);
            const double w = text_width(name, 10);
            const std::array<std::pair<double, double>, 6> places{{{point.x + 8, point.y - 6},
                                                                   {point.x + 8, point.y + 12},
                                                                   {point.x - 8 - w, point.y - 6},
                                                                   {point.x - 8 - w, point.y + 12},
                                                                   {point.x - w / 2, point.y - 9},
                                                                   {point.x - w / 2, point.y + 17}}};
            for (const auto& [x, y] : places) {
                const Box box{x, y - 9, x + w, y + 2};
                const bool outside =
                    box.left < left + 2 || box.right > right || box.top < top_ || box.bottom > bottom;
                const bool free = std::none_of(taken.begin(), taken.end(),
                                               [&](const Box& other) { return box.overlaps(other); });
                if (outside || !free) continue;
                drawing_.text("name", x, y, name);
                taken.push_back(box);
                break;
            }
        }
    }

    const ChartRows& data_;
    const RowGroup& group_;
    Cost cost_;
    ErrorKind kind_;
    Drawing drawing_;
    std::vector<Point> points_;
    std::optional<LogAxis> x_, y_;
    bool has_zero_ = false, has_infinite_ = false;
    double top_ = 0, plot_left_ = 0, plot_right_ = 0;
};

}  // namespace

std::optional<Drawing> pareto_chart(const ChartRows& data, const RowGroup& group, Cost cost,
                                    ErrorKind error) {
    return ParetoChart(data, group, cost, error).draw();
}

}  // namespace strandlab
