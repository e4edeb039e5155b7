// SPDX-License-Identifier: MIT
// The page: sections of text, tables, charts and matrices as data, and the file that shows them.
//
// One description, two readers. page_html() writes one self-contained file: everything as HTML and SVG, readable
// without scripts; and the charts once more as JSON, with the scripts that replace each picture by a live chart.
// page_json() is the whole page for a script that has the page open already: lqgPage.draw(JSON.parse(text)) draws it
// anew, in place of the old one, and keeps the curves that are hidden and the zoom. The top of emit/page/page.js says
// what lqgPage offers.
//
// Every word of these data is plain text, and is escaped where it is written.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "emit/text/chart.hpp"

namespace lqg::emit {

struct PageTable {
  std::string caption;                         // empty: none
  std::vector<std::string> head;               // empty: no row of titles
  std::vector<std::vector<std::string>> rows;  // the first cell of a row is its name
};

// Numbers with names of their rows and columns, as text that reads back exactly.
struct PageMatrix {
  std::string name;                        // "K": how it is called where it is copied to
  std::string words;                       // what it is: "gain of the regulator"; may be empty
  std::vector<std::string> rows, columns;  // names; may be empty
  std::vector<std::vector<std::string>> values;
  bool is_double = true;  // of C: double, else float
};

// What is shown of a section at a time. Where a section has several, a person chooses one of them by its name, and
// without scripts they stand below each other.
struct PageView {
  std::string name;  // of the choice; may be empty where there is one only
  std::string text;  // above the charts; may be empty
  std::vector<Chart> charts;
  std::string caption;  // below the charts; may be empty
  std::vector<PageTable> tables;
  std::vector<PageMatrix> matrices;
};

struct PageSection {
  std::string id;     // letters, digits and -; its own in the page
  std::string title;  // of the section: "At work"
  std::vector<PageView> views;
};

// A number beside what is required of it.
struct PageFigure {
  std::string name, value = {};  // "Phase margin", "41.2°"
  std::string requirement = {};  // "at least 30°"; empty: none
  bool is_met = true;
};

struct PageNote {
  std::string key;  // of the design file; may be empty
  std::string text;
};

struct PageData {
  std::string title, brief;         // name and brief of the design
  std::string made;                 // by whom, from what
  std::string verdict;              // one sentence
  bool is_sound = true;             // false: the verdict names something that is not met
  std::vector<PageNote> notes;      // what a person should look at
  std::vector<PageFigure> figures;  // six
  std::vector<PageSection> sections;
  std::string footer;
};

// What a page has beyond its data: for a program that serves it.
struct PageExtras {
  std::string panel;         // HTML, trusted: stands between the head and the sections
  std::string style;         // CSS, trusted
  std::string script;        // trusted; runs after page.js
  bool may_connect = false;  // scripts may talk to the server that the page came from
};

// Shortens curves and bands to at most 1500 points each, and to fewer, not below 150, where the page would have more
// than so many points in all: least and largest values stay.
void shorten(PageData& data, std::size_t points = 40000);

std::string page_html(const PageData& data, const PageExtras& extras = {});
std::string page_json(const PageData& data);

}  // namespace lqg::emit
