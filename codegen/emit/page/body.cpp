// SPDX-License-Identifier: MIT
#include "emit/page/body.hpp"

#include "emit/text/html.hpp"

namespace lqg::emit {

namespace {

constexpr std::size_t most_large = 12;  // charts of a view; more are small ones in an overview

std::string paragraph(const std::string& name, const std::string& text) {
  return text.empty() ? "" : "<p class=\"" + name + "\">" + escaped(text) + "</p>\n";
}

std::string notes(const PageData& data) {
  std::string out;
  for (const PageNote& note : data.notes)
    out +=
        "<li>" + (note.key.empty() ? "" : "<code>" + escaped(note.key) + "</code>: ") + escaped(note.text) + "</li>\n";
  return out.empty() ? "" : "<ul class=\"notes\">\n" + out + "</ul>\n";
}

std::string figures(const PageData& data) {
  std::string out;
  for (const PageFigure& figure : data.figures) {
    out += "<div><dt>" + escaped(figure.name) + "</dt><dd>" + escaped(figure.value) + "</dd>";
    if (!figure.requirement.empty())
      out += std::string("<dd class=\"requirement ") + (figure.is_met ? "met\">" : "missed\">") +
             escaped(figure.requirement) + "</dd>";
    out += "</div>\n";
  }
  return out.empty() ? "" : "<dl class=\"figures\">\n" + out + "</dl>\n";
}

std::string head(const PageData& data) {
  return "<header>\n<h1>" + escaped(data.title) + "</h1>\n" + paragraph("brief", data.brief) +
         paragraph("made", data.made) + paragraph(data.is_sound ? "verdict" : "verdict bad", data.verdict) +
         notes(data) + figures(data) + "</header>\n";
}

std::string row_of(const std::vector<std::string>& cells, const char* tag) {
  std::string out = "<tr>";
  for (const std::string& cell : cells) out += std::string("<") + tag + ">" + escaped(cell) + "</" + tag + ">";
  return out + "</tr>\n";
}

std::string table_of(const PageTable& table) {
  std::string out = "<div class=\"table\"><table>\n";
  if (!table.caption.empty()) out += "<caption>" + escaped(table.caption) + "</caption>\n";
  if (!table.head.empty()) out += "<thead>" + row_of(table.head, "th") + "</thead>\n";
  out += "<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) out += row_of(row, "td");
  return out + "</tbody></table></div>\n";
}

std::string tables(const PageView& view) {
  std::string out;
  for (const PageTable& table : view.tables)
    if (!table.rows.empty()) out += table_of(table);
  return out.empty() ? "" : "<div class=\"tables\">\n" + out + "</div>\n";
}

std::string matrix_of(const PageMatrix& matrix) {
  const std::size_t columns = matrix.values.empty() ? 0 : matrix.values.front().size();
  std::string out = "<details data-name=\"" + escaped(matrix.name) + "\"><summary>" + escaped(matrix.name) + " <span>" +
                    escaped(matrix.words) + (matrix.words.empty() ? "" : ", ") + std::to_string(matrix.values.size()) +
                    " × " + std::to_string(columns) + "</span></summary>\n<div class=\"matrix\" data-matrix=\"" +
                    escaped(matrix.name) + "\" data-real=\"" + (matrix.is_double ? "double" : "float") + "\"><table>\n";
  if (!matrix.columns.empty()) {
    std::vector<std::string> names = matrix.columns;
    if (!matrix.rows.empty()) names.insert(names.begin(), "");
    out += "<thead>" + row_of(names, "th") + "</thead>\n";
  }
  out += "<tbody>\n";
  for (std::size_t i = 0; i < matrix.values.size(); ++i) {
    out += "<tr>";
    if (!matrix.rows.empty()) out += "<th>" + escaped(matrix.rows[i]) + "</th>";
    for (const std::string& value : matrix.values[i]) out += "<td>" + escaped(value) + "</td>";
    out += "</tr>\n";
  }
  return out + "</tbody></table></div></details>\n";
}

// Charts stand in rows of equal height: of charts in a row two by two, the last of an odd number over the whole width;
// of squares three by three where there are three.
const char* place_of(const std::vector<Chart>& charts, std::size_t i) {
  std::size_t from = i, to = i + 1;
  while (from > 0 && charts[from - 1].is_square == charts[i].is_square) --from;
  while (to < charts.size() && charts[to].is_square == charts[i].is_square) ++to;
  const std::size_t count = to - from, left = to - i;
  if (count % 2 == 0) return "";
  if (charts[i].is_square && count >= 3) return left <= 3 ? " third" : "";
  return left == 1 ? " wide" : "";
}

std::string charts(const PageSection& section, std::size_t which, bool with_pictures) {
  const PageView& view = section.views[which];
  std::string out;
  for (std::size_t i = 0; i < view.charts.size(); ++i)
    out += std::string("<figure class=\"chart") + (view.charts[i].is_square ? " square" : "") +
           place_of(view.charts, i) + (with_pictures ? " pictured" : "") + "\" data-chart=\"" +
           chart_id(section, which, i) + "\">\n" + (with_pictures ? svg(view.charts[i]) : "") + "</figure>\n";
  if (out.empty()) return "";
  return std::string("<div class=\"charts") + (view.charts.size() > most_large ? " many" : "") + "\">\n" + out +
         "</div>\n";
}

std::string view_of(const PageSection& section, std::size_t which, bool with_pictures) {
  const PageView& view = section.views[which];
  std::string out = "<div class=\"view\" data-name=\"" + escaped(view.name) + "\">\n";
  if (!view.name.empty()) out += "<h3>" + escaped(view.name) + "</h3>\n";
  out += paragraph("text", view.text) + charts(section, which, with_pictures) + paragraph("caption", view.caption) +
         tables(view);
  for (const PageMatrix& matrix : view.matrices)
    if (!matrix.values.empty()) out += matrix_of(matrix);
  return out + "</div>\n";
}

}  // namespace

std::string chart_id(const PageSection& section, std::size_t view, std::size_t chart) {
  const std::string& id = section.views[view].charts[chart].id;
  return id.empty() ? section.id + "-" + std::to_string(view) + "-" + std::to_string(chart) : id;
}

std::string body(const PageData& data, bool with_pictures) {
  std::string out = head(data);
  for (const PageSection& section : data.sections) {
    out += "<section id=\"" + escaped(section.id) + "\">\n<h2>" + escaped(section.title) + "</h2>\n";
    for (std::size_t i = 0; i < section.views.size(); ++i) out += view_of(section, i, with_pictures);
    out += "</section>\n";
  }
  return out + (data.footer.empty() ? "" : "<footer>\n" + paragraph("made", data.footer) + "</footer>\n");
}

}  // namespace lqg::emit
