// The parts of a report's page, each as HTML; empty where the rows have nothing for it.
#pragma once

#include "report/html/page.h"

#include <string>

namespace strandlab {

/// What a reader must know before any figure: missing cases, mixed programs, wide spreads.
std::string notes_section(const PageData& data);

/// What to use when: sentences for each device, and a table of the choices of each group.
std::string words_section(const PageData& data);

/// Pareto charts of each group.
std::string tradeoff_section(const PageData& data);
/// Memory bars of each scene and device.
std::string memory_section(const PageData& data);
/// How often and how much rays are wrong, of each group.
std::string error_section(const PageData& data);
/// Bias and FLIP of pictures at growing distances.
std::string distance_section(const PageData& data);
std::string stress_section(const PageData& data);

/// The viewer of pictures, and their data: PNG files that rows name under "images".
std::string picture_section(const PageData& data);

/// The columns of the sortable table and the commands that reproduce the rows, as JSON for page.js.
std::string table_data(const PageData& data);

/// What was measured where, with what: programs, machines, devices, models, rays, settings.
std::string context_section(const PageData& data);

}  // namespace strandlab
