#include "framework/pipeline.h"

#include <exception>

#include "framework/config/document.h"
#include "framework/config/experiment.h"
#include "framework/interfaces/error.h"
#include "framework/metric/measure.h"
#include "framework/plugin/registry.h"
#include "framework/render_case.h"
#include "framework/report/interrupt.h"
#include "framework/report/judge.h"
#include "framework/report/log.h"
#include "framework/report/results_tree.h"

namespace dvrlab {

RunSummary run_experiment(const RunOptions& options) {
  const InterruptGuard guard;
  const ConfigDocument document = load_document(options.config, options.set);  // 1 config
  const Registry registry(options.plugin_path);                                // 2 plugins
  auto experiment = std::make_shared<const Experiment>(plan_experiment(document, registry));
  log_line("config", experiment->name + ": " + std::to_string(experiment->cases.size()) + " cases are valid");

  const ResultsTree results(options.out, experiment->name);
  CaseRenderer renderer(registry);
  Measurer measurer(*experiment, registry);
  Progress progress(experiment->cases.size());
  RunSummary summary{results.folder(), {}, false, experiment->cases.size(), experiment};
  for (std::size_t i = 0; i < experiment->cases.size() && !interrupted(); ++i) {
    const PlannedCase& c = experiment->cases[i];
    progress.show(i, c.id);
    CaseRecord record;
    record.plan = &c;
    try {
      const Scene& scene = renderer.scene(c.resolved, record);        // 3 scene
      FrameImage image = renderer.render(c.resolved, scene, record);  // 4 backend
      results.write_images(record, image);                            // 5 image
      record.ran = true;
      measurer.measure_case(i, std::move(image), record);  // 6 metrics
    } catch (const NotSupported& e) {
      record.judge(Verdict::not_supported, e.what());
    } catch (const std::exception& e) {
      record.judge(Verdict::error, e.what());
    } catch (...) {  // a plugin may throw anything; the other cases still run
      record.judge(Verdict::error, "an exception that is no std::exception");
    }
    results.write_case(record);  // 7 report
    summary.records.push_back(std::move(record));
    results.write_table(summary.records);
    measurer.done(i);
  }
  summary.stopped = summary.records.size() < summary.planned;
  judge_expectations(*experiment, summary.records);
  for (const CaseRecord& r : summary.records) {
    if (!r.expectations.empty()) results.write_case(r);
  }
  results.write_table(summary.records);
  results.write_views(summary.records);
  return summary;
}

}  // namespace dvrlab
