// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/html.hpp"
#include "waylode/eval/report.hpp"

namespace waylode::eval {

std::string to_html(const ReportOptions& options, std::span<const EvaluatedTrack> /*tracks*/,
                    std::span<const ResultRow> rows) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
         detail::escape_html(options.title) + "</title></head><body><h1>" +
         detail::escape_html(options.title) + "</h1><pre>" + detail::escape_html(to_text(rows)) +
         "</pre></body></html>\n";
}

}  // namespace waylode::eval
