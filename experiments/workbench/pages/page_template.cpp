// The only file that includes the template engine.
#include "experiments/workbench/pages/page_template.h"

#include <kainjow/mustache.hpp>
#include <map>
#include <stdexcept>

namespace hysteron::experiments {
namespace {

using kainjow::mustache::data;

data template_data(const Fields& fields) {
  data object;
  for (const auto& [name, value] : fields.items()) {
    if (value.is_string()) {
      if (value != "") object.set(name, value.get<std::string>());
    } else if (value.is_boolean()) {
      object.set(name, value.get<bool>());
    } else {
      kainjow::mustache::list list;
      for (const Fields& entry : value) list.push_back(template_data(entry));
      object.set(name, std::move(list));
    }
  }
  return object;
}

}  // namespace

std::string filled(const std::string& name, const Fields& fields) {
  kainjow::mustache::mustache engine(embedded_text(name));
  if (!engine.is_valid()) throw std::logic_error("template " + name + ": " + engine.error_message());
  engine.set_custom_escape(escaped);
  return engine.render(template_data(fields));
}

std::string embedded_text(const std::string& name) {
  const auto bytes = embedded_file(name);
  return {bytes.begin(), bytes.end()};
}

std::string escaped(const std::string& text) {
  static const std::map<char, std::string> kEscaped = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string html;
  for (const char c : text) {
    const auto known = kEscaped.find(c);
    html += known == kEscaped.end() ? std::string(1, c) : known->second;
  }
  return html;
}

}  // namespace hysteron::experiments
