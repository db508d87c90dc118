// The extension of VS Code, packed as it would be published.
#pragma once

#include "tests/support/outer_program.h"
#include "tests/support/places.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace ncvet::test {

inline const std::filesystem::path extensionFolder =
    std::filesystem::path(places::sourceFolder()) / "lsp" / "editors" / "vscode";

/// What an extension is packed with beside its client.
enum class PackedServer : uint8_t {
  None,     ///< all is checked that is checked before publishing
  Program,  ///< ncvet itself, in a package for this platform
  InBrowser ///< the WebAssembly module of `./dev package npm`, and no client for Node
};

/// The platform of the program, as packages name it.
inline constexpr const char *platform = "linux-x64";

/// Packs a copy of the extension in `folder`, which is made; the path of the package. Nothing when
/// npm cannot fetch what it is built with, or when it cannot be packed: `log` says which.
inline std::optional<std::filesystem::path>
packExtension(const std::filesystem::path &folder, const std::filesystem::path &log,
              PackedServer server = PackedServer::None) {
  namespace fs = std::filesystem;
  const auto modules = nodeModules(extensionFolder);
  if (!modules)
    return std::nullopt;
  // Where it is in the project: it takes the schemas and the viewer from there.
  const fs::path copy = folder / "lsp" / "editors" / "vscode";
  fs::create_directories(copy.parent_path());
  for (const char *read : {"rulesets", "formats"})
    fs::create_directory_symlink(fs::path(places::sourceFolder()) / read, folder / read);
  fs::copy(extensionFolder, copy, fs::copy_options::recursive | fs::copy_options::skip_symlinks);
  for (const char *made : {"bin", "dist", "node_modules", "schema", "server"})
    fs::remove_all(copy / made);
  fs::create_directory_symlink(*modules, copy / "node_modules");
  auto manifest = nlohmann::ordered_json::parse(contentsOf(copy / "package.json"));
  if (server == PackedServer::InBrowser) {
    fs::create_directory_symlink(fs::path(places::sourceFolder()) / "build", folder / "build");
    manifest.erase("main");
  }
  // The types are the same in each package, and to check them takes longest: once is enough.
  if (server != PackedServer::None) {
    auto &script = manifest["scripts"]["vscode:prepublish"];
    const std::string all = script, first = "npm run check && ";
    EXPECT_EQ(all.rfind(first, 0), 0u) << all;
    script = all.substr(first.size());
  }
  std::ofstream(copy / "package.json") << manifest.dump(2);
  std::vector<std::string> command = {"npm", "--prefix", copy.string(), "run", "package"};
  if (server == PackedServer::Program) {
    command.insert(command.begin(), {"env", "NCVET_PROGRAM=" + places::program()});
    command.insert(command.end(), {"--", "--target", platform});
  }
  if (runOuter(command, log, 300) != 0)
    return std::nullopt;
  const std::string name =
      server == PackedServer::Program ? std::string("ncvet-") + platform : "ncvet";
  return copy / (name + "-" + manifest["version"].get<std::string>() + ".vsix");
}

} // namespace ncvet::test
