#include "framework/app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "framework/app/cli_model.h"
#include "framework/app/help_text.h"
#include "framework/app/usage_error.h"
#include "framework/app/verbs.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

using VerbFunction = int (*)(const Options&);

/// CLI11's own check prints the largest double with all its digits.
std::string not_negative(std::string& word) {
  char* end = nullptr;
  const double x = std::strtod(word.c_str(), &end);
  return end == word.c_str() + word.size() && x >= 0 ? "" : "found " + word + ", must be a number of at least 0";
}

/// The definition; everything else about the command line is derived from it.
struct Definition {
  CLI::App app{"a laboratory for direct volume rendering", "dvrlab"};
  Options o;
  VerbFunction verb = nullptr;

  Definition() {
    app.require_subcommand(1);
    app.fallthrough();
    app.add_flag("--json", o.json, "machine-readable output on stdout");
    option(app, "--plugin-path", o.plugin_path, "DIR", "a folder with plugins; may be given more than once")
        ->allow_extra_args(false);
    app.set_version_flag("--version", version_text(), "version, plugin ABI and compiler");

    CLI::App& info = add("info", info_verb);
    option(info, "data", o.config, "FILE", "data file or folder, or a config with a data section")->required();
    config_options(info);
    option(info, "--starter", o.starter, "FILE", "writes a config that renders this data");
    info.add_flag("--force", o.force, "overwrites the file of --starter");
    option(info, "--plot", o.plot, "FILE",
           "draws the histogram and, of a config, its transfer functions; .svg or .png");
    option(info, "--bins", o.bins, "N", "bins of the histogram, 1 to 65536; 20 for people and 256 for machines")
        ->check(CLI::Range(1, 65536));

    CLI::App& render = add("render", render_verb);
    option(render, "config", o.config, "FILE", "config, case.json of an earlier run, or a data file or folder")
        ->required();
    config_options(render);
    option(render, "-o,--output", o.output, "FILE", "image file: .exr (float) or .png")->required();

    CLI::App& run = add("run", run_verb);
    config(run);
    option(run, "--out", o.out, "DIR", "results go to DIR/<experiment>")->capture_default_str();
    option(run, "--repeat", o.repeat, "N", "timed renders of each case, 1 to 1000")->check(CLI::Range(1, 1000));

    config(add("validate", validate_verb));

    CLI::App& compare = add("compare", compare_verb);
    option(compare, "a", o.a, "A", "EXR file or case folder")->required();
    option(compare, "b", o.b, "B", "the reference: EXR file or case folder")->required();
    option(compare, "--tolerance", o.tolerance, "X", "largest absolute difference that counts as equal; 0: every bit")
        ->check(CLI::Validator(not_negative, ""));
    option(compare, "--difference", o.difference, "FILE", "PNG of the colour difference of every pixel (CIELUV)");

    CLI::App& probe = add("probe", probe_verb);
    config(probe);
    option(probe, "--pixel", o.pixel, "X,Y", "from the top left, counted from 0")
        ->required()
        ->delimiter(',')
        ->expected(2);

    CLI::App& table = add("table", table_verb);
    config(table);
    option(table, "--points", o.points, "N", "values of v0 and of v1, 2 to 2048")
        ->check(CLI::Range(2, 2048))
        ->capture_default_str();
    option(table, "--repeat", o.repeat, "N", "timed builds of each table, 1 to 1000")->check(CLI::Range(1, 1000));
    option(table, "--out", o.out, "DIR", "results go to DIR/<experiment>/tables")->capture_default_str();

    option(add("list", list_verb), "kind", o.name, "KIND", "only this kind");
    option(add("describe", describe_verb), "type", o.name, "TYPE",
           "direct, estimator.direct, camera.perspective, image")
        ->required();
    CLI::App& new_plugin = add("new-plugin", new_plugin_verb);
    option(new_plugin, "kind", o.name, "KIND", "data, sampler, optical_model, estimator, illumination, metric, backend")
        ->required();
    option(new_plugin, "name", o.a, "NAME", "its type in configs: small letters, digits and _")->required();
    option(new_plugin, "--out", o.out_folder, "DIR",
           "make DIR/<name>, which builds by itself, wherever this is called");
    option(add("schema", schema_verb), "-o,--output", o.output, "FILE", "file; without it the schema goes to stdout");
    add("doctor", doctor_verb);
    option(add("completion", completion_verb), "shell", o.name, "SHELL", "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish", "types", "kinds"}));
    add("man", man_verb);
    option(add("help", help_verb), "verb", o.name, "VERB", "a verb; without one: the overview");
  }

  CLI::App& add(const std::string& name, VerbFunction function) {
    const auto& texts = verb_texts();
    const auto text = std::find_if(texts.begin(), texts.end(), [&](const VerbText& t) { return name == t.name; });
    if (text == texts.end()) throw std::logic_error("verb_texts.cpp says nothing of the verb " + name);
    CLI::App* sub = app.add_subcommand(name, text->summary);
    sub->callback([this, function] { verb = function; });
    return *sub;
  }

  /// `value` is what the help calls the value, and what the completion goes by: FILE, DIR, KIND, TYPE, VERB.
  template <class T>
  CLI::Option* option(CLI::App& to, const std::string& names, T& into, const char* value, const char* description) {
    return to.add_option(names, into, description)->type_name(value);
  }

  void config(CLI::App& to) {
    option(to, "config", o.config, "FILE", "config file, or the case.json of an earlier run")->required();
    config_options(to);
  }

  void config_options(CLI::App& to) {
    option(to, "--set", o.set, "KEY=VALUE", "a key of the config, sampling.step=0.5; may be given more than once")
        ->allow_extra_args(false);
  }
};

OptionModel model_of(const CLI::Option& option) {
  OptionModel m;
  for (const std::string& name : option.get_snames()) m.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) m.names.push_back("--" + name);
  // CLI11 writes "SHELL:{bash,zsh}" for a value with checks.
  const std::string type = option.get_type_name();
  const std::size_t open = type.find(":{");
  if (open != std::string::npos) m.choices = split_words(type.substr(open + 2, type.size() - open - 3), ',');
  const bool flag = !m.names.empty() && option.get_items_expected_max() == 0;
  if (!flag) m.value = type.substr(0, type.find(':'));
  m.description = option.get_description();
  m.default_value = option.get_default_str();
  m.required = option.get_required();
  m.repeats = option.get_allow_extra_args() || option.get_items_expected_max() > (1 << 20);
  return m;
}

std::vector<OptionModel> options_of(const CLI::App& app) {
  std::vector<OptionModel> options;
  for (const CLI::Option* option : app.get_options()) options.push_back(model_of(*option));
  std::stable_partition(options.begin(), options.end(), [](const OptionModel& o) { return o.argument(); });
  return options;
}

}  // namespace

ProgramModel program_model() {
  const Definition d;
  ProgramModel program{d.app.get_name(), d.app.get_description(), options_of(d.app), {}};
  std::erase_if(program.options, [](const OptionModel& o) { return o.names.empty(); });
  for (const VerbText& t : verb_texts()) {
    const CLI::App* sub = d.app.get_subcommand(t.name);
    VerbModel v{t.name,           t.group,   t.summary, t.description, t.json != nullptr ? t.json : "",
                options_of(*sub), t.examples};
    std::erase_if(v.options, [](const OptionModel& o) { return !o.argument() && o.names.back() == "--help"; });
    program.verbs.push_back(std::move(v));
  }
  return program;
}

int run_command_line(int argc, char** argv) {
  Definition d;
  try {
    d.app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto parsed = d.app.get_subcommands();
    const ProgramModel program = program_model();
    std::fputs(parsed.empty() ? overview(program).c_str() : verb_help(program, parsed[0]->get_name()).c_str(), stdout);
    return 0;
  } catch (const CLI::CallForVersion& e) {
    std::fputs(e.what(), stdout);
    return 0;
  } catch (const CLI::ParseError& e) {
    const ProgramModel program = program_model();
    if (argc == 1) std::fputs(overview(program).c_str(), stderr);
    std::fprintf(stderr, "error: %s\n", usage_error(program, {argv + 1, argv + argc}, e.what()).c_str());
    return 2;
  }
  return d.verb(d.o);
}

}  // namespace dvrlab
