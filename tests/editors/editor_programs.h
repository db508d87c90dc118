// Programs that editors open in tests: of every control, from the rules' pages, the golden programs
// and, when it is there, the corpus beside the project.
#pragma once

#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/process.h"
#include "tests/support/rule_pages.h"

#include "gtest/gtest.h"

namespace ncvet::test {

/// What an editor is to do in one session: steps, each with programs in a folder of their own, and
/// the plan that its script reads.
class EditorPlan {
public:
  explicit EditorPlan(const std::string &dialect) : dialect_(dialect) {
    plan_ = {{"ncvet", places::program()},
             {"result", (shop_->path() / "result").string()},
             {"settings", {{"dialect", dialect}}},
             {"steps", nlohmann::json::array()}};
  }

  /// Begins a step, to which everything that follows belongs.
  void begin(const std::string &step) {
    folder_ = "step-" + std::to_string(plan_["steps"].size());
    shop_->file(folder_ + "/.git/HEAD", ""); // one workspace: one server for its programs
    plan_["steps"].push_back({{"step", step}, {"programs", nlohmann::json::array()}});
  }
  /// A program that is opened. Programs of one name lie in folders of their own.
  std::string add(const std::string &name, const std::string &text) {
    std::string folder = folder_ + "/programs";
    for (unsigned i = 1; std::filesystem::exists(shop_->path() / folder / name); ++i)
      folder = folder_ + "/programs-" + std::to_string(i);
    shop_->file(folder + "/" + name, text);
    const std::string path = (shop_->path() / folder / name).string();
    step()["programs"].push_back({{"path", path}, {"dialect", dialect_}});
    return path;
  }
  /// A file that is there but not opened.
  std::string beside(const std::string &name, const std::string &text) {
    shop_->file(folder_ + "/programs/" + name, text);
    return (shop_->path() / folder_ / "programs" / name).string();
  }
  /// What else the step's function in the script reads.
  template <typename T>
  void set(const char *key, T value) {
    step()[key] = std::move(value);
  }

  /// The file with the plan, to be read by the editor's script.
  std::string write(const std::string &plugin) {
    plan_["plugin"] = plugin;
    shop_->file("plan.json", plan_.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    return (shop_->path() / "plan.json").string();
  }
  std::filesystem::path log() const { return shop_->path() / "log"; }
  const std::filesystem::path &folder() const { return shop_->path(); }

  /// Fails the test with what the script has written, unless it came to its end without a word.
  void expectDone(int status) const {
    const std::string said = shop_->text("result");
    EXPECT_EQ(said, "done\n") << "exit status " << status << "\n"
                              << contentsOf(log()).substr(0, 4000);
  }

private:
  nlohmann::json &step() { return plan_["steps"].back(); }

  std::string dialect_;
  std::string folder_; ///< of the step
  std::unique_ptr<Shop> shop_ = std::make_unique<Shop>();
  nlohmann::json plan_;
};

/// Controls that can be chosen.
inline std::vector<std::string> controls() {
  std::vector<std::string> ids;
  for (const DialectSummary &dialect : listDialects())
    if (!dialect.abstract)
      ids.push_back(dialect.id);
  return ids;
}

/// The control in the name of a test.
inline std::string controlName(const testing::TestParamInfo<std::string> &control) {
  std::string name = control.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// A file's ending that speaks for the control.
inline std::string endingOf(const std::string &dialect) {
  for (const DialectSummary &one : listDialects())
    if (one.id == dialect && !one.extensions.empty())
      return "." + one.extensions.front();
  return ".nc";
}

/// Up to `most` files of the corpus beside the project, spread over its folder for the control.
inline std::vector<std::filesystem::path> corpusOf(const std::string &dialect, size_t most) {
  static const std::map<std::string, const char *> folders = {
      {"ecs", "ecs"},
      {"mefi", "mefi"},
      {"sinumerik", "sinumerik"},
      {"haas-lathe", "haas-lathe"},
      {"haas-mill", "real/haas_mill"},
      {"fanuc-0m", "real/fanuc_mill"},
      {"fanuc-0t", "real/fanuc_lathe"},
      {"nct-104m", "fanuc-nct"},
      {"nct-104t", "fanuc-nct"},
      {"linuxcnc", "real/linuxcnc"},
      {"din66025", "real/iso_generic"},
  };
  namespace fs = std::filesystem;
  std::vector<fs::path> files, some;
  const auto folder = folders.find(dialect);
  const fs::path corpus = fs::path(places::sourceFolder()) / ".." / "shared" / "corpus";
  if (folder == folders.end() || !fs::is_directory(corpus / folder->second))
    return some;
  for (const auto &file : fs::recursive_directory_iterator(corpus / folder->second))
    // Templates are no programs.
    if (file.is_regular_file() && file.path().extension() != ".md" &&
        file.path().extension() != ".tmpl" && file.file_size() < 100000)
      files.push_back(file.path());
  std::sort(files.begin(), files.end());
  for (size_t i = 0; i < most && i < files.size(); ++i)
    some.push_back(files[i * files.size() / std::min(most, files.size())]);
  return some;
}

/// Adds a step with programs of a control: up to `most` of the pages, up to `most` of the corpus,
/// and all golden ones.
inline void addPrograms(EditorPlan &plan, const char *step, const std::string &dialect,
                        size_t most) {
  plan.begin(step);
  namespace fs = std::filesystem;
  std::vector<PageProgram> pages;
  for (PageProgram &page : allPagePrograms())
    if (page.dialect == dialect && page.wrong && page.machine.empty() && page.files.size() == 1)
      pages.push_back(std::move(page));
  for (size_t i = 0; i < most && i < pages.size(); ++i) {
    const PageProgram &page = pages[i * pages.size() / std::min(most, pages.size())];
    plan.add(page.name() + endingOf(dialect), page.files[0].text);
  }
  const fs::path golden = fs::path(places::sourceFolder()) / "tests" / "programs" / dialect;
  if (fs::is_directory(golden))
    for (const auto &file : fs::directory_iterator(golden))
      if (file.path().extension() == ".nc")
        plan.add(file.path().filename().string(), contentsOf(file.path()));
  for (const fs::path &file : corpusOf(dialect, most))
    plan.add(file.filename().string(), contentsOf(file));
}

} // namespace ncvet::test
