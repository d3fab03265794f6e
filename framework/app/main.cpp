// The command line: which verbs and options there are. What they do is in verb_<name>.cpp.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "framework/app/verbs.h"
#include "framework/interfaces/error.h"

namespace {

using dvrlab::Options;

void print_errors(const std::string& lines) {
  std::size_t begin = 0;
  while (begin <= lines.size()) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    std::fprintf(stderr, "error: %s\n", lines.substr(begin, end - begin).c_str());
    begin = end + 1;
  }
}

void config_options(CLI::App& verb, Options& o) {
  verb.add_option("config", o.config, "config file, or the case.json of an earlier run")->required();
  verb.add_option("--set", o.set, "key.path=value over the config; may be given more than once")
      ->allow_extra_args(false);
}

int run_command_line(int argc, char** argv) {
  Options o;
  int repeat = 0;
  int (*verb)(const Options&) = nullptr;
  CLI::App app{"dvrlab: a laboratory for direct volume rendering", "dvrlab"};
  app.require_subcommand(1);
  app.fallthrough();
  app.add_flag("--json", o.json, "machine-readable output on stdout");
  app.add_option("--plugin-path", o.plugin_path, "a folder with plugins; may be given more than once")
      ->allow_extra_args(false);
  const auto add = [&](const char* name, const char* help, int (*function)(const Options&)) {
    CLI::App* sub = app.add_subcommand(name, help);
    sub->callback([&verb, function] { verb = function; });
    return sub;
  };

  CLI::App* run = add("run", "run an experiment: all cases of its axes, measured and judged", dvrlab::run_verb);
  config_options(*run, o);
  run->add_option("--out", o.out, "results go to OUT/<experiment>")->capture_default_str();
  run->add_option("--repeat", repeat, "timed renders of each case")->check(CLI::Range(1, 1000));

  CLI::App* render = add("render", "render one case to an image", dvrlab::render_verb);
  config_options(*render, o);
  render->add_option("-o,--output", o.output, "image file: .exr (float) or .png")->required();

  CLI::App* list = add("list", "list the plugins that were found, and the framework's own types", dvrlab::list_verb);
  list->add_option("kind", o.name, "only this kind");

  CLI::App* describe =
      add("describe", "describe a type: its parameters, units, defaults, source", dvrlab::describe_verb);
  describe->add_option("type", o.name, "e.g. direct, estimator.direct, camera.perspective, image")->required();

  CLI::App* validate = add("validate", "check a config and all its cases without rendering", dvrlab::validate_verb);
  config_options(*validate, o);

  CLI::App* compare = add("compare", "compare two images (EXR files or case folders)", dvrlab::compare_verb);
  compare->add_option("a", o.a, "EXR file or case folder")->required();
  compare->add_option("b", o.b, "the reference: EXR file or case folder")->required();
  compare->add_option("--tolerance", o.tolerance, "largest absolute difference that counts as equal; 0: every bit")
      ->check(CLI::NonNegativeNumber);

  CLI::App* probe = add("probe", "list every segment of the ray through one pixel", dvrlab::probe_verb);
  config_options(*probe, o);
  probe->add_option("--pixel", o.pixel, "X,Y from the top left, counted from 0")
      ->required()
      ->delimiter(',')
      ->expected(2);

  CLI::App* new_plugin =
      add("new-plugin", "make a plugin of your own from the template of its kind", dvrlab::new_plugin_verb);
  new_plugin->add_option("kind", o.name, "data, sampler, optical_model, estimator, illumination, metric or backend")
      ->required();
  new_plugin->add_option("name", o.a, "its type in configs: small letters, digits and _")->required();
  new_plugin->add_option("--out", o.out_folder, "make OUT/<name>, which builds by itself, wherever this is called");

  CLI::App* schema = add("schema", "the JSON Schema of configs, for editors", dvrlab::schema_verb);
  schema->add_option("-o,--output", o.output, "file; without it the schema goes to stdout");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  if (repeat > 0) o.set.push_back("repeat=" + std::to_string(repeat));
  return verb(o);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_command_line(argc, argv);
  } catch (const dvrlab::InputError& e) {
    print_errors(e.what());
    return 2;
  } catch (const std::exception& e) {  // NotSupported among them
    print_errors(e.what());
    return 3;
  }
}
