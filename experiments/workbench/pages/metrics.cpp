#include "experiments/workbench/pages/metrics.h"

#include <algorithm>
#include <set>

#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/page.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {

std::vector<std::pair<std::string, Metrics>> columns_in(const Metrics& metrics) {
  std::vector<std::pair<std::string, Metrics>> columns;
  for (const auto& [key, value] : metrics) {
    const std::size_t dot = key.rfind('.');
    if (dot == key.npos) continue;
    const std::string name = key.substr(0, dot);
    auto column =
        std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.first == name; });
    if (column == columns.end()) column = columns.insert(columns.end(), {name, {}});
    column->second.set(key.substr(dot + 1), value);
  }
  return columns;
}

const std::vector<Headline>& column_headlines(const Manifest& manifest) {
  const std::string compared = manifest.text("compared");
  return experiment_headlines(compared.empty() ? manifest.experiment : compared).all;
}

ShownQuantity metric_text(const Metrics& metrics, const std::string& key) {
  if (is_headline(metrics, key)) return headline_text(metrics, key);
  const ShownQuantity words{shown(metrics[key]), split_unit(key).unit};
  return is_asked_for(key) ? with_rest_warning(words, metrics, key) : words;
}

namespace {

Fields card(const ShownQuantity& words, const std::string& name) {
  return {{"value", words.value}, {"more", words.more()}, {"name", name}};
}

std::string html_cards(const std::vector<Fields>& cards) {
  return cards.empty() ? "" : filled("cards.html", {{"cards", cards}});
}

// Replaces value and unit by those with an SI prefix.
ShownQuantity prefixed(ShownQuantity words, const Metrics& metrics, const std::string& key) {
  const ShownQuantity quantity = shown_quantity(metrics[key], split_unit(key).unit);
  return {quantity.value, quantity.unit, std::move(words.errors)};
}

Fields headline_card(const Metrics& metrics, const Headline& headline, const std::string& name) {
  const std::string key = headline.metric;
  const ShownQuantity words = headline_text(metrics, headline);
  const bool has_errors = is_headline(metrics, key) || metrics.contains(key + kStandardError);
  return card(has_errors || headline.scale == 1 ? words : prefixed(words, metrics, key), name);
}

// Returns a card for each law or fabric with the first headline that they have.
std::vector<Fields> column_cards(const Manifest& manifest) {
  constexpr std::size_t kMax = 8;  // more become a table
  const auto columns = columns_in(manifest.metrics);
  for (const Headline& headline : column_headlines(manifest)) {
    std::vector<Fields> cards;
    for (const auto& [name, own] : columns)
      if (own[headline.metric].is_number())
        cards.push_back(headline_card(own, headline, name + ": " + headline.words));
    if (!cards.empty()) return cards.size() <= kMax ? cards : std::vector<Fields>{};
  }
  return {};
}

std::vector<Fields> answers(const Manifest& manifest) {
  std::vector<Fields> cards;
  for (const Headline& headline : experiment_headlines(manifest.experiment).all) {
    const MetricValue& value = manifest.metrics[headline.metric];
    if (value.is_text() && value.text() != "unknown")
      cards.push_back(card({value.text(), ""}, headline.words));
    if (value.is_number()) cards.push_back(headline_card(manifest.metrics, headline, headline.words));
  }
  return cards.empty() ? column_cards(manifest) : cards;
}

}  // namespace

std::string metric_cards(const Metrics& metrics) {
  std::vector<Fields> cards;
  for (const auto& [key, value] : metrics) {
    if (key.find('.') != key.npos || !described_headline(metrics, key).empty()) continue;
    const ShownQuantity words = metric_text(metrics, key);
    cards.push_back(
        card(is_headline(metrics, key) ? words : prefixed(words, metrics, key), split_unit(key).name));
  }
  return html_cards(cards);
}

std::string answer_cards(const Manifest& manifest) { return html_cards(answers(manifest)); }

std::string first_answer(const Manifest& manifest) {
  const std::vector<Fields> cards = answers(manifest);
  if (cards.empty()) return "";
  const auto text = [&](const char* key) { return cards[0].at(key).get<std::string>(); };
  return joined({text("value"), text("more"), text("name")}, " ");
}

Metrics further_metrics(const Manifest& manifest) {
  std::set<std::string> answers;
  for (const Headline& headline : experiment_headlines(manifest.experiment).all)
    answers.insert(headline.metric);
  Metrics further;
  for (const auto& [key, value] : manifest.metrics) {
    const std::string headline = described_headline(manifest.metrics, key);
    if (!answers.contains(headline.empty() ? key : headline) && !is_numerics(key)) further.set(key, value);
  }
  return further;
}

Metrics numerics(const Metrics& metrics) {
  Metrics solver;
  for (const auto& [key, value] : metrics)
    if (is_numerics(key)) solver.set(key, value);
  return solver;
}

std::string metric_table(const Metrics& metrics) {
  const auto columns = columns_in(metrics);
  if (columns.empty()) return "";
  std::vector<std::string> keys;
  for (const auto& [name, own] : columns)
    for (const auto& [key, value] : own)
      if (described_headline(own, key).empty() && !std::count(keys.begin(), keys.end(), key))
        keys.push_back(key);
  std::vector<std::string> head = {""};
  std::vector<std::size_t> numeric;
  for (const std::string& key : keys) {
    numeric.push_back(head.size());
    head.push_back(split_unit(key).text());
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, own] : columns) {
    rows.push_back({name});
    for (const std::string& key : keys) {
      const ShownQuantity words = own.contains(key) ? metric_text(own, key) : ShownQuantity{};
      rows.back().push_back(joined({words.value, words.errors}, " "));
    }
  }
  return html_table(head, rows, numeric);
}

std::string missing_errors(const Manifest& manifest) {
  const std::string text = join(manifest.errors_missing, "; ");
  return html_about(text.empty() ? "" : "Errors that are not known: " + text + ".");
}

}  // namespace hysteron::experiments
