// Batches: which command lines a manifest makes, what is refused, and what a second run does again.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/laboratory/batch_cases.h"
#include "fuai/laboratory/batch_run.h"

using namespace fuai;

namespace {

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() / ("fuai-test-batch-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

using Words = std::vector<std::string>;

BatchGrammar grammar() {
  using Kind = BatchOption::Kind;
  BatchGrammar made;
  made.commands = {
      {"drape",
       {"fabric"},
       {{"disc", Kind::kText}, {"runs", Kind::kInteger}, {"elastic", Kind::kFlag}, {"out", Kind::kFile}}},
      {"kes", {"test", "fabric"}, {{"spacing", Kind::kText}, {"reverse", Kind::kText}}},
      {"simulate", {"scene"}, {{"fabric", Kind::kText}, {"dt", Kind::kText}}}};
  made.problem = [](const Words& words) {
    return std::ranges::find(words, "refused") == words.end() ? "" : "--disc: refused not in range";
  };
  return made;
}

BatchCases cases_of(const std::string& body, const std::string& manifest = "m.toml",
                    const std::string& folder = "DIR") {
  return make_batch_cases(parse_batch_manifest("format = \"fuai-batch/1\"\n" + body, manifest), grammar(),
                          folder);
}

std::vector<std::string> lines(const BatchCases& made) {
  std::vector<std::string> all;
  for (const BatchCase& one : made.cases) {
    std::string line;
    for (const std::string& word : one.words) line += (line.empty() ? "" : " ") + word;
    all.push_back(line);
  }
  return all;
}

Error refusal(const std::string& body) {
  try {
    cases_of(body);
  } catch (const Error& e) {
    return e;
  }
  FAIL_CHECK("nothing was refused: " << body);
  return Error(ErrorKind::kUsage, "none");
}

/// A case that a shell runs.
BatchCase shell_case(const std::string& id, const std::string& line) {
  BatchCase one;
  one.id = id;
  one.words = {"run", id};
  one.line = {"-c", line};
  one.input_hash = "0";
  return one;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("fabrics, variants and settings multiply, the last setting fastest") {
    const BatchCases made = cases_of(
        "fabrics = [\"wool-tropical\", \"graded-1\"]\n[[cases]]\ncommand = \"drape\"\n"
        "runs = [1, 2]\nelastic = [false, true]\nvariants = [{disc = \"18cm\"}, {disc = \"9cm\", seed = "
        "7}]\n");
    const std::vector<std::string> all = lines(made);
    REQUIRE(all.size() == 16);
    CHECK(all[0] == "--json --seed 0 --threads 1 drape wool-tropical --disc 18cm --runs 1");
    CHECK(all[1] == "--json --seed 0 --threads 1 drape wool-tropical --disc 18cm --runs 1 --elastic");
    CHECK(all[2] == "--json --seed 0 --threads 1 drape wool-tropical --disc 18cm --runs 2");
    CHECK(all[4] == "--json --seed 7 --threads 1 drape wool-tropical --disc 9cm --runs 1");
    CHECK(all[8] == "--json --seed 0 --threads 1 drape graded-1 --disc 18cm --runs 1");
    std::set<std::string> ids;
    for (const BatchCase& one : made.cases) {
      ids.insert(one.id);
      CHECK(one.line == one.words);  // bundled fabrics, no files
      CHECK(one.where.line == 4);
    }
    CHECK(ids.size() == 16);
    CHECK(made.cases[0].id.starts_with("drape-wool-tropical-"));
    CHECK(made.cases[0].input_hash != made.cases[8].input_hash);
    CHECK(
        made.cases[5].settings ==
        std::vector<std::pair<std::string, std::string>>{
            {"fabric", "wool-tropical"}, {"disc", "9cm"}, {"seed", "7"}, {"runs", "1"}, {"elastic", "true"}});
  }

  TEST_CASE("words, lists of words, fabrics as an option, and commands without a fabric") {
    const BatchCases made = cases_of(
        "[[cases]]\ncommand = \"kes\"\nfabrics = \"graded-3\"\ntest = [\"bending\", \"shear\"]\n"
        "reverse = [[\"1\", \"-1.5:0.5\"], \"-2\"]\nthreads = 2\n"
        "[[cases]]\ncommand = \"simulate\"\nscene = \"yank\"\n"
        "[[cases]]\ncommand = \"simulate\"\nscene = \"yank\"\nfabrics = \"graded-3\"\ndt = \"1ms\"\n");
    CHECK(lines(made) == std::vector<std::string>{
                             "--json --seed 0 --threads 2 kes bending graded-3 --reverse 1 -1.5:0.5",
                             "--json --seed 0 --threads 2 kes bending graded-3 --reverse=-2",
                             "--json --seed 0 --threads 2 kes shear graded-3 --reverse 1 -1.5:0.5",
                             "--json --seed 0 --threads 2 kes shear graded-3 --reverse=-2",
                             "--json --seed 0 --threads 1 simulate yank",
                             "--json --seed 0 --threads 1 simulate yank --fabric graded-3 --dt 1ms",
                         });
    CHECK(made.cases[4].id.starts_with("simulate-"));
  }

  TEST_CASE("the name of a case depends on its command line, not on the order or the place of the manifest") {
    const std::string fabric = read_text_file(data_folder() + "/fabrics/graded-1.fabric.toml");
    const Folder folder;
    std::filesystem::create_directories(folder / "sub");
    write_atomically(folder / "sub/a.fabric.toml", fabric);
    write_atomically(folder / "sub/b.fabric.toml", fabric);
    const std::string head = "[[cases]]\ncommand = \"drape\"\nfabrics = \"sub/\"\n";
    const BatchCases one = cases_of(head + "runs = 1\ndisc = \"9cm\"\nout = \"o\"\n", folder / "m.toml");
    const BatchCases two =
        cases_of(head + "out = \"o\"\ndisc = \"9cm\"\nruns = 1\n", folder / "sub/../m.toml", "D2");
    REQUIRE(one.cases.size() == 2);
    CHECK(one.cases[0].id == two.cases[0].id);
    CHECK(one.cases[0].words == two.cases[0].words);
    CHECK(one.cases[0].words[6] == "sub/a.fabric.toml");
    CHECK(one.cases[0].line[6] == folder / "sub/a.fabric.toml");
    CHECK(one.cases[0].line.back() == "DIR/files/" + one.cases[0].id + "/o");
    CHECK(two.cases[1].file_folder == "D2/files/" + one.cases[1].id);
    // A changed fabric is another input of the same case.
    write_atomically(folder / "sub/a.fabric.toml", fabric + "\n[drape]\nnode_count = 3\n");
    const BatchCases three = cases_of(head + "runs = 1\ndisc = \"9cm\"\nout = \"o\"\n", folder / "m.toml");
    CHECK(three.cases[0].id == one.cases[0].id);
    CHECK(three.cases[0].input_hash != one.cases[0].input_hash);
    CHECK(three.cases[1].input_hash == one.cases[1].input_hash);
    // One that cannot be read is a case too: it fails on its own.
    write_atomically(folder / "sub/b.fabric.toml", "broken");
    CHECK(cases_of(head, folder / "m.toml").cases.size() == 2);
    CHECK(cases_of("[[cases]]\ncommand = \"drape\"\nfabrics = \"bundled\"\n").cases.size() == 8);
  }

  TEST_CASE("a command line that comes up again runs once") {
    const BatchCases made = cases_of(
        "fabrics = \"graded-1\"\n[[cases]]\ncommand = \"drape\"\nruns = [1, 1, 2]\n[[cases]]\ncommand = "
        "\"drape\"\nruns = 2\n");
    CHECK(made.cases.size() == 2);
    CHECK(made.repeated == 2);
  }

  TEST_CASE("what is wrong is refused at its place, with what would be right") {
    const std::string head = "fabrics = \"graded-1\"\n[[cases]]\ncommand = \"drape\"\n";  // lines 2 to 4
    struct Wrong {
      std::string body;
      int line;
      std::string key, says;
    };
    const std::vector<Wrong> all{
        {"[[cases]]\ncommand = \"drap\"\n", 3, "cases[0].command", "did you mean drape?"},
        {"[[cases]]\ncommand = \"drape\"\n", 3, "cases[0].command", "there is no fabric"},
        {head + "dics = \"9cm\"\n", 5, "cases[0].dics", "did you mean disc?"},
        {head + "disc = 9\n", 5, "cases[0].disc", "disc = \"9cm\""},
        {head + "disc = true\n", 5, "cases[0].disc", "a value is expected"},
        {head + "elastic = 1\n", 5, "cases[0].elastic", "true or false"},
        {head + "fabric = \"graded-1\"\n", 5, "cases[0].fabric", "write fabrics ="},
        {head + "out = \"../o\"\n", 5, "cases[0].out", "no name of a file"},
        {head + "out = \"/o\"\n", 5, "cases[0].out", "no name of a file"},
        {head + "runs = 1\ndisc = [\"9cm\", \"refused\"]\n", 6, "cases[0].disc", "not in range"},
        {"fabrics = [\"graded-1\",\n \"graded-2\"]\n[[cases]]\ncommand = \"drape\"\n", 3, "fabrics",
         "did you mean graded-"},
        {"fabrics = \"x/none.fabric.toml\"\n[[cases]]\ncommand = \"drape\"\n", 2, "fabrics",
         "does not exist"},
        {"fabrics = \"none/\"\n[[cases]]\ncommand = \"drape\"\n", 2, "fabrics", "cannot be read"},
        {"fabrics = \"graded-1\"\n[[cases]]\ncommand = \"kes\"\n", 4, "cases[0].command", "needs 'test'"},
    };
    for (const Wrong& wrong : all) {
      CAPTURE(wrong.body);
      const Error error = refusal(wrong.body);
      CHECK(error.kind() == ErrorKind::kBadInput);
      CHECK(error.where().file == "m.toml");
      CHECK(error.where().line == wrong.line);
      CHECK(error.where().key == wrong.key);
      CHECK_MESSAGE(std::string(error.what()).find(wrong.says) != std::string::npos, error.what());
    }
    std::string many = head + "runs = [1", more = "\nseed = [1";
    for (int i = 2; i <= 400; ++i) many += "," + std::to_string(i), more += "," + std::to_string(i);
    CHECK(std::string(refusal(many + "]" + more + "]\n").what()).find("more than 100000 cases") !=
          std::string::npos);
  }

  TEST_CASE("durations are told as people do") {
    CHECK(duration_text(0.4) == "0 s");
    CHECK(duration_text(59.4) == "59 s");
    CHECK(duration_text(59.6) == "1 min");
    CHECK(duration_text(3570.0) == "1 h 0 min");
    CHECK(duration_text(7800.0) == "2 h 10 min");
  }
}

TEST_SUITE("safety") {
  TEST_CASE("a second run does what is not finished, and only that") {
    const Folder folder;
    const std::string log = folder / "log";
    const auto ok = [&](const std::string& id) {
      return shell_case(id, "echo " + id + " >>" + log + "; echo '{\"a\": 1}'");
    };
    std::vector<BatchCase> cases{ok("one"), ok("two"),
                                 shell_case("bad", "echo bad >>" + log + "; echo fuai: no >&2; exit 3"),
                                 shell_case("killed", "echo killed >>" + log + "; kill -9 $$"),
                                 shell_case("mute", "echo mute >>" + log + "; echo no JSON")};
    BatchOptions options;
    options.folder = folder / "out";
    options.program = "/bin/sh";
    options.version = "1";
    options.jobs = 2;
    const auto run = [&] {
      std::filesystem::remove(log);
      const BatchOutcome outcome = run_batch(cases, options);
      std::set<std::string> ran;
      std::string text = std::filesystem::exists(log) ? read_text_file(log) : std::string();
      for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        CHECK(ran.insert(text.substr(at, text.find('\n', at) - at)).second);  // none twice
      CHECK(outcome.ran == static_cast<int>(ran.size()));
      CHECK(outcome.kept + outcome.ran == static_cast<int>(cases.size()));
      CHECK(outcome.failed() == 3);
      return ran;
    };
    using Names = std::set<std::string>;
    CHECK(run() == Names{"one", "two", "bad", "killed", "mute"});
    // What a signal ended may do better the next time; an exit code comes back the same.
    CHECK(run() == Names{"killed"});
    const std::string file = options.folder + "/cases/one.json", text = read_text_file(file);
    write_atomically(file, text.substr(0, text.size() / 2));
    CHECK(run() == Names{"one", "killed"});
    std::filesystem::remove(file);
    CHECK(run() == Names{"one", "killed"});
    cases[1].words.emplace_back("more");
    CHECK(run() == Names{"two", "killed"});
    cases[1].input_hash = "1";
    CHECK(run() == Names{"two", "killed"});
    options.retry = true;
    CHECK(run() == Names{"bad", "killed", "mute"});
    options.retry = false;
    options.version = "2";
    CHECK(run() == Names{"one", "two", "bad", "killed", "mute"});
    // A subset, as a cluster's queue runs it, makes the same files.
    std::filesystem::remove(file);
    run_batch(std::vector<BatchCase>{cases[0]}, options);
    CHECK(run() == Names{"killed"});
  }
}
