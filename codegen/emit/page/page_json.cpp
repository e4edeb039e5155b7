// SPDX-License-Identifier: MIT
#include "emit/page/page_json.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "emit/page/body.hpp"

namespace lqg::emit {

namespace {

using Json = nlohmann::ordered_json;

// The number of six digits that is nearest.
double six_digits(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 5);
  double out = value;
  std::from_chars(text, end.ptr, out);
  return out + 0.0;  // not −0
}

constexpr double not_finite = std::numeric_limits<double>::quiet_NaN();

std::vector<double> six_digits(const std::vector<double>& values) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const double value : values) out.push_back(std::isfinite(value) ? six_digits(value) : not_finite);
  return out;
}

// Of numbers of six digits.
Json list_of(const std::vector<double>& values) {
  Json::array_t out;
  out.reserve(values.size());
  for (const double value : values) out.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  return out;
}

// Many curves have the same x, or are there twice: each list of numbers stands there once.
class Lists {
 public:
  std::size_t index_of(const std::vector<double>& values) {
    const auto [place, is_new] = index_.try_emplace(bits_of(values), 0);
    if (is_new) place->second = index_of_rounded(six_digits(values));
    return place->second;
  }
  Json taken() { return std::move(lists_); }

 private:
  using Index = std::unordered_map<std::string, std::size_t>;

  static std::string bits_of(const std::vector<double>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
  }
  std::size_t index_of_rounded(const std::vector<double>& values) {
    const auto [place, is_new] = rounded_.try_emplace(bits_of(values), lists_.size());
    if (is_new) lists_.push_back(list_of(values));
    return place->second;
  }

  Index index_, rounded_;
  Json lists_ = Json::array();
};

const char* name_of(Mark mark) {
  switch (mark) {
    case Mark::line: return "line";
    case Mark::dashes: return "dashes";
    case Mark::dash_dots: return "dash-dots";
    case Mark::dotted: return "dotted";
    case Mark::steps: return "steps";
    case Mark::dots: return "dots";
    case Mark::crosses: return "crosses";
    case Mark::pluses: return "pluses";
    case Mark::rings: return "rings";
    default: return "squares";
  }
}

const char* name_of(Role role) { return role == Role::data ? "data" : role == Role::ghost ? "ghost" : "grid"; }

Json json_of(const Axis& axis) { return {{"label", axis.label}, {"log", axis.is_logarithmic}}; }

Json curves_of(const Chart& chart, Lists& lists) {
  Json out = Json::array();
  for (const Curve& curve : chart.curves) {
    out.push_back({{"label", curve.label},
                   {"owner", curve.owner},
                   {"mark", name_of(curve.mark)},
                   {"colour", curve.colour},
                   {"role", name_of(curve.role)},
                   {"x", lists.index_of(curve.x)},
                   {"y", lists.index_of(curve.y)}});
    if (!curve.texts.empty()) out.back()["texts"] = curve.texts;
  }
  return out;
}

Json bands_of(const Chart& chart, Lists& lists) {
  Json out = Json::array();
  for (const Band& band : chart.bands)
    out.push_back({{"label", band.label},
                   {"owner", band.owner},
                   {"colour", band.colour},
                   {"x", lists.index_of(band.x)},
                   {"low", lists.index_of(band.low)},
                   {"high", lists.index_of(band.high)}});
  return out;
}

// What stands at places: circles, lines, words, events.
void add_marks(Json& out, const Chart& chart) {
  out["circles"] = out["guides"] = out["notes"] = out["events"] = Json::array();
  for (const Circle& circle : chart.circles)
    out["circles"].push_back(
        {{"x", six_digits(circle.x)}, {"y", six_digits(circle.y)}, {"radius", six_digits(circle.radius)}});
  for (const Guide& guide : chart.guides)
    out["guides"].push_back(
        {{"axis", guide.axis == Guide::Axis::x ? "x" : "y"}, {"at", six_digits(guide.at)}, {"label", guide.label}});
  for (const Note& note : chart.notes)
    out["notes"].push_back({{"x", six_digits(note.x)},
                            {"y", six_digits(note.y)},
                            {"dx", six_digits(note.dx)},
                            {"dy", six_digits(note.dy)},
                            {"text", note.text}});
  for (const EventMark& event : chart.events)
    out["events"].push_back({{"at", six_digits(event.at)}, {"label", event.label}});
}

Json json_of(const Chart& chart, const std::string& id, Lists& lists) {
  const Window view = window_of(chart);
  Json out = {{"id", id},
              {"title", chart.title},
              {"group", chart.group},
              {"square", chart.is_square},
              {"x", json_of(chart.x)},
              {"y", json_of(chart.y)},
              {"view", list_of(six_digits({view.x_low, view.x_high, view.y_low, view.y_high}))},
              {"curves", curves_of(chart, lists)},
              {"bands", bands_of(chart, lists)}};
  add_marks(out, chart);
  return out;
}

// Of a text of ASCII: what could end a script, or begin a comment in it, has a < in it.
std::string without_tags(const std::string& text) {
  std::string out;
  for (const char c : text) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

}  // namespace

std::string json_of(const PageData& data, bool with_body) {
  Lists lists;
  Json charts = Json::array();
  for (const PageSection& section : data.sections)
    for (std::size_t view = 0; view < section.views.size(); ++view)
      for (std::size_t i = 0; i < section.views[view].charts.size(); ++i)
        charts.push_back(json_of(section.views[view].charts[i], chart_id(section, view, i), lists));
  Json out = {{"title", data.title}};
  if (with_body) out["body"] = body(data, false);
  out["lists"] = lists.taken();
  out["charts"] = std::move(charts);
  return without_tags(out.dump(-1, ' ', true, Json::error_handler_t::replace));
}

}  // namespace lqg::emit
