// Pieces of pages from the files in templates/ (https://mustache.github.io/mustache.5.html), which the build
// puts into the binary.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace hysteron::experiments {

// What a template is filled with, by name: {{text}} escaped or {{{html}}} as it is, {{#truth}} and {{#list}}
// for sections.  An empty text is one that is not there.
using Fields = nlohmann::ordered_json;

// The template of that file name, "table.html", filled.  std::logic_error if the file is no template.
std::string filled(const std::string& name, const Fields& fields);

// A file of templates/ as it is; Error::system if a list forgotten in CMakeLists.txt has left it out.
std::span<const unsigned char> embedded_file(std::string_view name);
std::string embedded_text(const std::string& name);

// Text as HTML: & < > " escaped.
std::string escaped(const std::string& text);

}  // namespace hysteron::experiments
