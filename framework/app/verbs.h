// The verbs of the command line. Each returns the exit code: 0 all good, 1 an expectation or a comparison failed,
// 2 the input is wrong, 3 something could not run. InputError and NotSupported are turned into 2 and 3 by main().
#pragma once

#include <string>
#include <vector>

namespace dvrlab {

/// What was asked for on the command line. A verb reads the fields that its help names.
struct Options {
  std::vector<std::string> plugin_path;
  bool json = false;
  std::string config;  // of render and info: or a data file or folder
  std::vector<std::string> set;
  std::string out = "out";
  std::string output;      // render -o, schema -o
  std::string name;        // list KIND, describe TYPE, completion SHELL, help VERB, new-plugin KIND
  std::string a, b;        // compare; new-plugin NAME
  std::string out_folder;  // new-plugin --out
  double tolerance = 0;    // compare
  std::string difference;  // compare: PNG
  std::vector<int> pixel;  // probe
  int repeat = 0;          // run; 0: as the config says
  std::string starter;     // info --starter
  bool force = false;      // info
  std::string plot;        // info --plot
  int bins = 0;            // info; 0: 20 for people, 256 for machines
  int points = 128;        // table
};

int info_verb(const Options& options);
int render_verb(const Options& options);
int run_verb(const Options& options);
int validate_verb(const Options& options);
int compare_verb(const Options& options);
int probe_verb(const Options& options);
int table_verb(const Options& options);
int list_verb(const Options& options);
int describe_verb(const Options& options);
int doctor_verb(const Options& options);
int completion_verb(const Options& options);
int man_verb(const Options& options);
int help_verb(const Options& options);
int new_plugin_verb(const Options& options);
int schema_verb(const Options& options);

}  // namespace dvrlab
