// The completion scripts, run in their shells.
#include <algorithm>
#include <sstream>

#include "tests/app/program.h"

namespace dvrlab::app_test {
namespace {

class Completion : public Program {
 protected:
  static std::vector<std::string> lines(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);)
      if (!line.empty()) all.push_back(line.substr(0, line.find('\t')));
    std::sort(all.begin(), all.end());
    return all;
  }
  /// What bash offers for the last of the words.
  std::vector<std::string> bash(const std::string& words) const {
    write("complete.bash",
          "source <(dvrlab completion bash)\nCOMP_WORDS=(" + words +
              ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_dvrlab\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
    const Outcome o = run("bash complete.bash");
    EXPECT_EQ(o.err, "");
    return lines(o.out);
  }
  std::vector<std::string> fish(const std::string& line) const {
    const Outcome o = run("HOME=$PWD fish -c 'dvrlab completion fish | source; complete -C \"" + line + "\"'");
    EXPECT_EQ(o.code, 0) << o.err;
    return lines(o.out);
  }
};

using Words = std::vector<std::string>;

TEST_F(Completion, Bash) {
  DVRLAB_NEEDS("bash", "bash");
  EXPECT_EQ(bash("dvrlab ren"), Words{"render"});
  EXPECT_EQ(bash("dvrlab nothing_like_it"), Words{});
  EXPECT_EQ(bash("dvrlab ''").size(), json_of("dvrlab help --json")["verbs"].size());
  EXPECT_EQ(bash("dvrlab render --ou"), Words{"--output"});
  EXPECT_EQ(bash("dvrlab run --ou"), Words{"--out"}) << "each verb has its own options";
  EXPECT_EQ(bash("dvrlab man --js"), Words{}) << "man has no --json";
  EXPECT_EQ(bash("dvrlab --plugin-path x run --rep"), Words{"--repeat"}) << "a value is no verb";
  EXPECT_EQ(bash("dvrlab describe absorp"), Words{"absorption_emission"});
  EXPECT_EQ(bash("dvrlab list estim"), Words{"estimator"});
  EXPECT_EQ(bash("dvrlab completion f"), Words{"fish"});
  EXPECT_EQ(bash("dvrlab help doc"), Words{"doctor"});
  EXPECT_EQ(bash("dvrlab validate configs/first"), Words{"configs/first_experiment.json"});
  EXPECT_EQ(bash("dvrlab info data/fuel"), Words{"data/fuel.nrrd"});
  EXPECT_EQ(bash("dvrlab run --out conf"), Words{"configs"}) << "folders";
  EXPECT_EQ(bash("dvrlab render --set ''"), Words{}) << "a key: the shell does not know it";
}

TEST_F(Completion, Fish) {
  DVRLAB_NEEDS("fish", "fish");
  EXPECT_EQ(fish("dvrlab ren"), Words{"render"});
  EXPECT_EQ(fish("dvrlab render --outp"), Words{"--output"});
  EXPECT_EQ(fish("dvrlab describe absorp"), Words{"absorption_emission"});
  EXPECT_EQ(fish("dvrlab nothing_like_it"), Words{});
}

TEST_F(Completion, Zsh) {
  DVRLAB_NEEDS("zsh", "zsh");
  // An interactive zsh on a terminal of its own; Tab completes the only candidate. Nothing is typed before the line
  // editor says that it listens: until then the terminal itself takes Tab and Control-U.
  write("complete.zsh", R"(zmodload zsh/zpty
zpty z "HOME=$PWD PATH=$PATH zsh -f -i"
zpty -w z 'autoload -U compinit; compinit -u -D; source <(dvrlab completion zsh)'
zpty -w z 'zle-line-init() { print -n EDITOR"_LISTENS" }; zle -N zle-line-init'
zpty -r z seen '*EDITOR_LISTENS*'
for line in 'dvrlab doct' 'dvrlab render --outp' 'dvrlab describe absorp'; do
  zpty -w -n z "$line"$'\t'"x"$'\C-u\n'
  zpty -r z seen '*EDITOR_LISTENS*'
  print -r -- "$seen"
done
zpty -d z
)");
  const Outcome o = run("timeout 60 zsh -f complete.zsh");
  EXPECT_EQ(o.code, 0) << o.err << o.out;
  expect_words(o.out, {"doctor", "--output", "absorption_emission"});
}

TEST_F(Completion, InstalledFilesAreWhatIsPrinted) {
  for (const auto& [arguments, file] :
       {std::pair<std::string, std::string>{"completion bash", "share/bash-completion/completions/dvrlab"},
        {"completion zsh", "share/zsh/site-functions/_dvrlab"},
        {"completion fish", "share/fish/vendor_completions.d/dvrlab.fish"},
        {"man", "share/man/man1/dvrlab.1"}})
    EXPECT_EQ(run("dvrlab " + arguments).out, run("cat " DVRLAB_BUILD "/" + file).out) << file;
}

TEST_F(Completion, ManualPageIsClean) {
  DVRLAB_NEEDS("mandoc", "mandoc");
  const std::string page = run("dvrlab man > dvrlab.1; cat dvrlab.1").out;
  // A page of no fixed date is the same page every day; that is all that may be said against it.
  EXPECT_EQ(run("mandoc -T lint -W warning dvrlab.1 | grep -v 'missing date'").out, "");
  write("bad.1", page + ".SH\n.nonsense\n");
  EXPECT_NE(run("mandoc -T lint -W warning bad.1 | grep -v 'missing date'").out, "") << "a page that is wrong";
  const std::string text = run("mandoc -T ascii dvrlab.1 | col -b | tr -s ' \\n' ' '").out;
  const nlohmann::json model = json_of("dvrlab help --json");
  for (const nlohmann::json& verb : model["verbs"]) {
    expect_words(text, {"dvrlab " + verb["name"].get<std::string>()});
    for (const nlohmann::json& option : verb["options"])
      for (const nlohmann::json& name : option["names"]) expect_words(text, {name});
  }
  expect_words(text, {"EXIT STATUS", "DVRLAB_PLUGIN_PATH"});
}

TEST_F(Completion, ManReadsThePageWithoutWarnings) {
  DVRLAB_NEEDS("man", "man-db");
  const Outcome o = run("dvrlab man > dvrlab.1; LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings -l ./dvrlab.1");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
  expect_words(o.out, {"dvrlab"});
}

}  // namespace
}  // namespace dvrlab::app_test
