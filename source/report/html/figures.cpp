#include "report/html/figures.h"

#include "base/error.h"
#include "base/file.h"
#include "report/file_name.h"
#include "report/html/page.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <system_error>

namespace strandlab {
namespace {

/// Writes charts under names that are all different.
class FigureFolder {
  public:
    explicit FigureFolder(std::string folder) : folder_(std::move(folder)) {
        std::error_code error;
        std::filesystem::create_directories(folder_, error);
        if (error) fail(ExitCode::bad_input, "{}: cannot be made ({})", folder_, error.message());
    }

    void write(const std::string& stem, const char* chart, const std::optional<Drawing>& drawing) {
        if (!drawing) return;
        std::string name = stem + "." + chart;
        for (int i = 2; !names_.insert(name).second; ++i) name = stem + "." + chart + "-" + std::to_string(i);
        write_file((std::filesystem::path(folder_) / (name + ".svg")).string(), drawing->file());
    }
    size_t count() const { return names_.size(); }

  private:
    std::string folder_;
    std::set<std::string> names_;
};

}  // namespace

size_t write_figures(const MergedResults& results, const std::string& folder) {
    const PageData data(results);
    const ChartRows rows = data.charts();
    FigureFolder figures(folder);
    std::set<std::pair<std::string, std::string>> with_memory;
    for (const RowGroup& group : data.groups) {
        const std::string scene = file_name_of(group.scene), device = file_name_of(group.device);
        const std::string stem = scene + "." + file_name_of(group.rays) + "." + device;
        if (!group.hit_or_miss_only) {
            figures.write(stem, "time-error", pareto_chart(rows, group, Cost::time, ErrorKind::distance));
            figures.write(stem, "memory-error", pareto_chart(rows, group, Cost::memory, ErrorKind::distance));
        }
        figures.write(stem, "time-wrong", pareto_chart(rows, group, Cost::time, ErrorKind::wrong));
        figures.write(stem, "memory-wrong", pareto_chart(rows, group, Cost::memory, ErrorKind::wrong));
        figures.write(stem, "outcomes", outcome_chart(rows, group));
        figures.write(stem, "model-error", exceedance_chart(rows, group, Against::curves));
        figures.write(stem, "intersector-error", exceedance_chart(rows, group, Against::own_surface));
        figures.write(stem, "model-histogram", histogram_chart(rows, group, Against::curves));
        figures.write(stem, "intersector-histogram", histogram_chart(rows, group, Against::own_surface));
        for (const auto& [figure, title] : distance_figures)
            figures.write(stem, file_name_of(figure).c_str(),
                          distance_chart(rows, group, std::string(figure), std::string(title)));
        if (with_memory.emplace(group.scene, group.device).second)
            figures.write(scene + "." + device, "memory", memory_chart(rows, group));
    }
    figures.write("stress", "heat-map", stress_chart(results.stress));
    return figures.count();
}

}  // namespace strandlab
