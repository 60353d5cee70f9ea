// The report: one HTML file that opens offline.
#pragma once

#include "report/html/charts.h"
#include "report/merged_results.h"

#include <cstddef>
#include <string>
#include <vector>

namespace strandlab {

/// How a report is made.
struct PageOptions {
    std::string title = "Hair primitives: time, memory, error";
    bool pictures = true;  // put the rows' pictures into the page
};

/// Everything that sections of a page draw from.
struct PageData {
    const MergedResults& results;
    std::vector<FrontMarks> marks;
    std::vector<RowGroup> groups;

    explicit PageData(const MergedResults& merged);
    ChartRows charts() const;
};

/// The whole page. It needs no other file and asks the network for nothing, which its content security
/// policy also forbids; all that rows say is escaped. The same rows give the same bytes.
std::string report_page(const MergedResults& results, const PageOptions& options);

/// Text with {{NAME}} replaced by the value of that name; values are not searched again. Asserts that every
/// name has one.
std::string filled_template(std::string_view text,
                            const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace strandlab
