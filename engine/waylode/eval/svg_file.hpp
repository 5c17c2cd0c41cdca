// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace waylode::eval {

/// A drawing made for the report's page.
struct SvgDrawing {
  double width_px = 0.0;
  double height_px = 0.0;
  std::string svg;  ///< One <svg> element with a viewBox of that size.
};

struct LegendEntry {
  std::string classes;  ///< As of method_classes().
  std::string text;     ///< Plain.
};

/// Drawings side by side under a title, the legend below, as a file of its own: style included,
/// light colours, nothing from elsewhere. `definitions` are referred to by the drawings.
std::string svg_file(const std::vector<SvgDrawing>& drawings, const std::string& title,
                     const std::vector<LegendEntry>& legend, const std::string& definitions = {});

}  // namespace waylode::eval
