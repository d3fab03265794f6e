#include "framework/report/summary.h"

#include <algorithm>

#include "framework/report/text_table.h"
#include "framework/report/view_report.h"

namespace dvrlab {
namespace {

constexpr std::size_t most_rows = 100;

std::size_t count(const RunSummary& s, Verdict v) {
  return static_cast<std::size_t>(
      std::count_if(s.records.begin(), s.records.end(), [&](const CaseRecord& r) { return r.verdict == v; }));
}

std::string row_time(const CaseRecord& r) {
  const std::optional<double> march = r.seconds("march");
  const std::optional<double> time = march ? march : r.seconds("frame");
  return time ? short_number(*time * 1000) + " ms" : "-";
}

struct Worst {
  const CaseRecord* record = nullptr;
  std::size_t compared = 0;
};

Worst worst_variant(const RunSummary& s) {
  Worst worst;
  for (const CaseRecord& r : s.records) {
    if (!r.variant) continue;
    ++worst.compared;
    if (worst.record == nullptr || r.variant->max_abs > worst.record->variant->max_abs) worst.record = &r;
  }
  return worst;
}

/// What the experiment asked to compare, and what came of it.
struct Comparisons {
  std::size_t planned = 0, made = 0;
  bool in_vain() const { return planned > 0 && made == 0; }
};

Comparisons with_variants(const RunSummary& s) {
  Comparisons c;
  for (std::size_t i = 0; i < s.experiment->cases.size(); ++i) c.planned += s.experiment->cases[i].first_variant != i;
  for (const CaseRecord& r : s.records) c.made += r.variant.has_value();
  return c;
}

Comparisons with_references(const RunSummary& s) {
  Comparisons c;
  for (const PlannedCase& p : s.experiment->cases) c.planned += !p.references.empty() && !p.resolved.metrics.empty();
  for (const CaseRecord& r : s.records) {
    c.made +=
        std::any_of(r.measures.begin(), r.measures.end(), [](const Measure& m) { return m.against != "variant"; });
  }
  return c;
}

}  // namespace

int exit_code(const RunSummary& s) {
  if (count(s, Verdict::fail) > 0) return 1;
  const bool some_ran = std::any_of(s.records.begin(), s.records.end(), [](const CaseRecord& r) { return r.ran; });
  // An expectation of a case that ran, but that nothing was measured for, has not been met.
  const bool unjudged = std::any_of(s.records.begin(), s.records.end(), [](const CaseRecord& r) {
    return r.ran && std::any_of(r.expectations.begin(), r.expectations.end(),
                                [](const ExpectationResult& e) { return e.verdict == Verdict::not_supported; });
  });
  return count(s, Verdict::error) > 0 || s.stopped || !some_ran || unjudged || with_variants(s).in_vain() ||
                 with_references(s).in_vain()
             ? 3
             : 0;
}

std::string summary_text(const RunSummary& s) {
  std::vector<std::vector<std::string>> rows = {{"case", "backend", "march", "verdict", "max difference"}};
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;  // what was said -> of which cases
  const auto say = [&](const std::string& what, const std::string& id) {
    const auto known = std::find_if(reasons.begin(), reasons.end(), [&](const auto& r) { return r.first == what; });
    if (known == reasons.end()) {
      reasons.push_back({what, {id}});
    } else {
      known->second.push_back(id);
    }
  };
  for (const CaseRecord& r : s.records) {
    const bool shown = s.records.size() <= most_rows || r.verdict != Verdict::pass;
    if (shown)
      rows.push_back({r.plan->id, r.plan->resolved.backend.type, row_time(r), verdict_text(r.verdict),
                      r.variant ? short_number(r.variant->max_abs) : "-"});
    bool said = false;
    for (const ExpectationResult& e : r.expectations) {
      say(std::string(verdict_text(e.verdict)) + ": expected " + e.text + ": " + e.reason, r.plan->id);
      said = said || e.verdict == r.verdict;
    }
    if (!r.reason.empty() && !said) say(std::string(verdict_text(r.verdict)) + ": " + r.reason, r.plan->id);
  }
  std::string text = text_table(rows);
  if (s.records.size() > most_rows) text += "(cases that passed are not listed: see results.csv)\n";
  for (const auto& [what, ids] : reasons) {
    text.append(what).append(" [").append(ids.front());
    if (ids.size() > 1) text.append(" and ").append(std::to_string(ids.size() - 1)).append(" more");
    text += "]\n";
  }
  text += view_text(s.records, most_rows);
  const Worst worst = worst_variant(s);
  if (worst.record != nullptr) {
    text += "variants: " + std::to_string(worst.compared) + " compared bit for bit, worst difference " +
            short_number(worst.record->variant->max_abs) +
            (worst.record->variant->different > 0 ? " (" + worst.record->plan->id + ")" : "") + "\n";
  }
  if (with_variants(s).in_vain()) text += "variants: none could be compared, so nothing is known of their equality\n";
  if (with_references(s).in_vain()) text += "references: nothing could be measured against any of them\n";
  text += "verdicts:";
  for (const Verdict v : {Verdict::pass, Verdict::fail, Verdict::not_supported, Verdict::error}) {
    text += (v == Verdict::pass ? " " : ", ") + std::to_string(count(s, v)) + " " + verdict_text(v);
  }
  text += "\n";
  if (s.stopped)
    text += "stopped after " + std::to_string(s.records.size()) + " of " + std::to_string(s.planned) + " cases\n";
  return text + "results: " + s.folder + "\n";
}

nlohmann::ordered_json summary_json(const RunSummary& s) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const CaseRecord& r : s.records) cases.push_back(case_json(r));
  return {{"folder", s.folder},        {"stopped", s.stopped},          {"planned", s.planned},
          {"exit_code", exit_code(s)}, {"views", view_json(s.records)}, {"cases", cases}};
}

}  // namespace dvrlab
