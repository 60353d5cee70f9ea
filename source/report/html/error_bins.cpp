#include "report/html/error_bins.h"

#include "report/row_fields.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace strandlab {

std::string distance_path(Against against) {
    return against == Against::curves ? "model_error.all.distance." : "intersector_error.decisive.distance.";
}

std::optional<ErrorBins> error_bins(const nlohmann::ordered_json& row, Against against) {
    const nlohmann::ordered_json* counts = field_at(row, distance_path(against) + "decades");
    ErrorBins bins{};
    if (!counts || !counts->is_array() || counts->size() != bins.size()) return std::nullopt;
    double sum = 0;
    for (size_t i = 0; i < bins.size(); ++i) {
        const nlohmann::ordered_json& count = (*counts)[i];
        bins[i] = count.is_number() ? count.get<double>() : -1;
        if (!(bins[i] >= 0 && std::isfinite(bins[i]))) return std::nullopt;
        sum += bins[i];
    }
    if (!(sum > 0)) return std::nullopt;
    for (double& share : bins) share /= sum;
    return bins;
}

double lower_edge(size_t bin) {
    return bin == 0 ? 0 : std::pow(10, Percentiles::first_decade + static_cast<double>(bin) - 1);
}

}  // namespace strandlab
