#include "framework/app/verb_texts.h"

namespace dvrlab {
namespace {

constexpr const char* images = "Images and experiments";
constexpr const char* parts = "Parts and this machine";
constexpr const char* help = "Help";

}  // namespace

const std::vector<VerbText>& verb_texts() {
  static const std::vector<VerbText> texts = {
      {"info",
       images,
       "what is in a data file: dims, values, orientation, histogram",
       "Reads a data file, a folder of files, or the data section of a config, and says what is in it: grid, type, "
       "spacing, position of the axes in words, range of the physical values with quantiles and a histogram. With "
       "--starter it also writes a config that renders the data: a commented file to start from. --plot draws "
       "the histogram with a logarithmic axis; below it, of a config, every pair of transfer functions as a bar (nodes "
       "joined by straight lines, the colour with the amount as its alpha) and discrete isosurfaces as spikes.",
       "everything that was found, the histogram as counts",
       {{"dvrlab info data/engine.nrrd", "the grid, its values and their histogram"},
        {"dvrlab info data/engine.nrrd --starter my.json", "writes a config for this data, to be edited"},
        {"dvrlab info my.json --plot tf.svg", "draws the transfer functions of the config over the histogram"},
        {"dvrlab info data/marschner_lobb.nii.gz --json --bins 64", "the same for programs, 64 bins"}}},
      {"render",
       images,
       "render one image, of a config or directly of a data file",
       "Renders one image, .exr (float) or .png. Given a data file instead of a config, it first makes a starter "
       "config "
       "from the data's histogram and orientation, and says what it chose; `dvrlab info FILE --starter` writes that "
       "config.",
       "the case: resolved config, device, counters, times",
       {{"dvrlab render data/engine.nrrd -o image.png", "a picture of a data file, without a config"},
        {"dvrlab render my.json -o image.exr", "a config's image as floats"},
        {"dvrlab render my.json --set sampling.step=0.25 --set 'image.background=[1,1,1]' -o fine.png",
         "with other values for two keys"}}},
      {"run",
       images,
       "run an experiment: all cases of its axes, measured and judged",
       "Renders every case of an experiment, measures each against its references, judges the expectations and writes "
       "the results tree OUT/<experiment>/. A case that cannot run does not keep the others from it. The case.json of "
       "an earlier run is an experiment too: it renders the same image again.",
       "the summary: verdicts, times and differences of all cases",
       {{"dvrlab run configs/first_experiment.json", "results go to out/first_experiment"},
        {"dvrlab run configs/first_experiment.json --set 'image.size=[128,128]' --repeat 3 --out small",
         "smaller images, each timed three times, in small/first_experiment"},
        {"dvrlab run out/first_experiment/cases/sampling.step=1,backend=cpu/case.json --out again",
         "one case of an earlier run again"}}},
      {"validate",
       images,
       "check a config and all its cases without rendering",
       "Resolves every case of a config against the declarations of its plugins and says everything that is wrong, "
       "each with file, line and column, the nearest legal name and the legal values. Data files are not read.",
       "the ids of the cases, or the errors",
       {{"dvrlab validate my.json", "is the config right?"},
        {"dvrlab validate configs/quickstart.json --json", "the ids of all cases"}}},
      {"compare",
       images,
       "compare two images (EXR files or case folders)",
       "Compares two float images of one size: how many numbers differ, by how much at most, and every metric that is "
       "installed. The second image is the reference. Exit code 1 when they differ by more than the tolerance. The "
       "picture of "
       "--difference is grey where the difference is not noticeable (below 1 in CIELUV) and coloured from there on.",
       "the same numbers",
       {{"dvrlab compare out/first_experiment/cases/sampling.step=1,backend=cpu "
         "out/first_experiment/cases/reference=fine --tolerance 0.5",
         "how far is a case from the reference?"},
        {"dvrlab compare image.exr image.exr", "the same image?"},
        {"dvrlab compare image.exr image.exr --difference delta_e.png", "where would an eye see it?"}}},
      {"probe",
       images,
       "list every segment of the ray through one pixel",
       "Follows the ray of one pixel and prints each segment: where it lies, its value, its own radiance and "
       "transmittance and those of the ray behind it.",
       "the segments as a list",
       {{"dvrlab probe my.json --pixel 320,320", "the ray through the middle of a 640 x 640 image"},
        {"dvrlab probe my.json --pixel 320,320 --json", "the same for programs"}}},
      {"table",
       images,
       "size, build time and errors of an estimator's tables",
       "Studies the tables of every case of a config: their size, the time to build them, and the error of one segment "
       "of the nominal step between any two values v0 and v1 against the exact integral in fp64, over a grid of pairs: "
       "worst and rms, in classes of the segment's optical depth, and as a picture (v0 to the right, v1 upwards; black "
       "1e-8, then blue, green, orange every two decades, white 1). Axes work as in an experiment: estimators, table "
       "sizes, families of transfer functions. Light factors are 1.",
       "the same numbers as a list",
       {{"dvrlab table configs/papers/lee_shin2013/fig05.json --points 64",
         "the methods of a figure, in out/fig05/tables"},
        {"dvrlab table my.json --set estimator.type=power_series --repeat 20 --json", "one of them, built 20 times"}}},
      {"list",
       parts,
       "the plugins that were found, and the framework's own types",
       "Lists every type that a config can name, with what is wrong with those that cannot be used.",
       "the list",
       {{"dvrlab list", "everything"}, {"dvrlab list estimator", "one kind"}, {"dvrlab list --json", "for programs"}}},
      {"describe",
       parts,
       "the parameters of a type: unit, default, legal values, source",
       "Describes a type of a config: what it is, where its method was published, and every key with unit, default, "
       "legal values and whether it changes pixels. Of a section it lists the types.",
       "the same as a list of types",
       {{"dvrlab describe absorption_emission", "a plugin"},
        {"dvrlab describe camera", "a section: its types"},
        {"dvrlab describe camera.orbit", "a type of the framework"},
        {"dvrlab describe image --json", "a section without types, for programs"}}},
      {"new-plugin",
       parts,
       "make a plugin of your own from the template of its kind",
       "Copies the template of a kind and gives it a name: host code, kernel where the kind has one, page, example and "
       "test, ready to build. Inside dvrlab's source tree it becomes plugins/<kind>/<name>; elsewhere, or with --out, "
       "a "
       "folder that builds by itself against the installed dvrlab. Nothing is overwritten.",
       nullptr,
       {{"dvrlab new-plugin estimator my_estimator", "an estimator for all backends"},
        {"dvrlab new-plugin metric my_metric --out my_plugins", "a metric, in my_plugins/my_metric"}}},
      {"schema",
       parts,
       "the JSON Schema of configs, for editors",
       "Writes one JSON Schema (draft-07) of a whole config, made from the declarations of the framework and of every "
       "plugin that was found: an editor completes keys with it and shows units, defaults and legal values.",
       nullptr,
       {{"dvrlab schema -o dvrlab.schema.json", "to a file, to be named by the editor or by \"$schema\""},
        {"dvrlab schema", "to stdout"}}},
      {"doctor",
       parts,
       "what this machine offers, what is missing, and the package that has it",
       "Looks for everything that a render may need: processor, Vulkan and OpenGL devices with their drivers and "
       "limits, "
       "plugin folders, broken plugins, plugins that were not built, the cache, memory. What is missing is named with "
       "its "
       "Debian package. Exit code 0 when at least one backend can render, else 3.",
       "the whole report",
       {{"dvrlab doctor", "a page for people"}, {"dvrlab doctor --json", "for programs and bug reports"}}},
      {"completion",
       help,
       "print the completion script of a shell",
       "Prints a script that teaches a shell to complete verbs, options, files and the names of types. `types` and "
       "`kinds` "
       "print the words that the scripts ask for.",
       nullptr,
       {{"dvrlab completion bash > dvrlab.bash",
         "for bash: source it, or put it in "
         "~/.local/share/bash-completion/completions/dvrlab"},
        {"dvrlab completion zsh > _dvrlab", "for zsh: into a folder of $fpath"},
        {"dvrlab completion fish > dvrlab.fish", "for fish: into ~/.config/fish/completions"}}},
      {"man",
       help,
       "print the manual page",
       "Prints the manual page in the format of man(7), made from the same definition as this help.",
       nullptr,
       {{"dvrlab man > dvrlab.1", "to be read with man ./dvrlab.1"}}},
      {"help",
       help,
       "the help of a verb",
       "Prints the overview, or the help of one verb. `dvrlab VERB --help` does the same.",
       "the whole command line as data: verbs, options, examples, exit codes",
       {{"dvrlab help render", "the help of one verb"}, {"dvrlab help --json", "the command line as data"}}},
  };
  return texts;
}

const std::vector<ExitCode>& exit_codes() {
  static const std::vector<ExitCode> codes = {
      {0, "all good"},
      {1, "an expectation or a comparison failed"},
      {2, "the input is wrong: command line, config or file"},
      {3, "something could not run: a device, a library, memory or data is missing"},
  };
  return codes;
}

const std::vector<EnvironmentVariable>& environment_variables() {
  static const std::vector<EnvironmentVariable> variables = {
      {"DVRLAB_PLUGIN_PATH", "More folders with plugins, separated by colons."},
      {"DVRLAB_CACHE", "The folder of compiled shaders; else $XDG_CACHE_HOME/dvrlab, else ~/.cache/dvrlab."},
      {"VK_DRIVER_FILES", "Read by the Vulkan loader: the drivers that it offers."},
  };
  return variables;
}

}  // namespace dvrlab
