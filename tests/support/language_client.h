// A client of the language server in a test: the real binary, spoken to message by message.
#pragma once

#include "tests/support/message_process.h"
#include "tests/support/places.h"

#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

namespace ncvet::test {

/// Names a file to which clients add what the server sends, one message a line.
inline constexpr const char *recordVariable = "NCVET_TEST_MESSAGES";

/// Diagnostics as "LINE RULE", lines from 1.
inline std::vector<std::string> codes(const Json &diagnostics) {
  std::vector<std::string> all;
  for (const Json &diagnostic : diagnostics)
    all.push_back(std::to_string(diagnostic["range"]["start"]["line"].get<int>() + 1) + " " +
                  diagnostic["code"].get<std::string>());
  return all;
}

/// The folder as the only one of a workspace, as `initialize` takes it.
inline Json workspaceOf(const std::filesystem::path &folder) {
  return Json::array({{{"uri", "file://" + folder.string()}, {"name", "shop"}}});
}

/// Starts `ncvet lsp` and talks to it. Answers and notifications are waited for with a limit; what
/// does not come in time is a failure of the test and reads as null.
class LanguageClient : public MessageProcess {
public:
  explicit LanguageClient(const std::string &binary = places::program())
      : MessageProcess(binary, "lsp") {}

  void notify(const std::string &method, Json params) {
    send({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}});
  }
  int64_t ask(const std::string &method, Json params) {
    asked_[++lastId_] = method;
    send({{"jsonrpc", "2.0"}, {"id", lastId_}, {"method", method}, {"params", std::move(params)}});
    return lastId_;
  }
  /// The whole answer to a request.
  Json answer(int64_t id) {
    return next([id](const Json &message) {
      return !message.contains("method") && message.value("id", Json()) == Json(id);
    });
  }
  /// The result of a request; an error is a failure of the test.
  Json request(const std::string &method, Json params) {
    Json message = answer(ask(method, std::move(params)));
    if (!message.is_object() || !message.contains("result")) {
      ADD_FAILURE() << method << ": " << message.dump();
      return nullptr;
    }
    return std::move(message["result"]);
  }
  /// Parameters of the next notification of this method.
  Json notification(const std::string &method) {
    const Json message =
        next([&](const Json &m) { return m.value("method", Json()) == Json(method); });
    return message.is_object() ? message.value("params", Json()) : Json();
  }
  /// The next request of the server with this method, whole.
  Json serverRequest(const std::string &method) {
    return next([&](const Json &m) {
      return m.value("method", Json()) == Json(method) && m.contains("id");
    });
  }
  /// Answers a request of the server.
  void reply(const Json &request, Json result) {
    send({{"jsonrpc", "2.0"}, {"id", request["id"]}, {"result", std::move(result)}});
  }
  /// The next message that is an error without a request.
  Json complaint() {
    return next(
        [](const Json &m) { return m.contains("error") && m.value("id", Json(0)).is_null(); });
  }

  Json initialize(Json capabilities = Json::object(), Json options = Json::object(),
                  Json folders = nullptr) {
    Json result = request("initialize", {{"processId", nullptr},
                                         {"rootUri", nullptr},
                                         {"capabilities", std::move(capabilities)},
                                         {"initializationOptions", std::move(options)},
                                         {"workspaceFolders", std::move(folders)}});
    notify("initialized", Json::object());
    return result;
  }
  void open(const std::string &path, const std::string &text,
            const std::string &language = "gcode") {
    notify(
        "textDocument/didOpen",
        {{"textDocument",
          {{"uri", "file://" + path}, {"languageId", language}, {"version", 1}, {"text", text}}}});
  }
  /// The diagnostics of the version of a document, once they come.
  Json diagnostics(const std::string &path, int version = 1) {
    Json message = next([&](const Json &m) {
      return m.value("method", "") == "textDocument/publishDiagnostics" &&
             m["params"]["uri"] == "file://" + path && m["params"].value("version", 0) == version;
    });
    return message.is_object() ? std::move(message["params"]["diagnostics"]) : Json();
  }

  int shutDown() {
    request("shutdown", nullptr);
    notify("exit", nullptr);
    return exitCode();
  }

private:
  Json next(const std::function<bool(const Json &)> &wanted) {
    for (auto at = kept_.begin(); at != kept_.end(); ++at)
      if (wanted(*at)) {
        Json message = std::move(*at);
        kept_.erase(at);
        return message;
      }
    Json message;
    while (read(message)) {
      if (wanted(message))
        return message;
      kept_.push_back(std::move(message));
    }
    ADD_FAILURE() << "the message that was waited for did not come";
    return nullptr;
  }

  bool read(Json &message) {
    if (!receive(message))
      return false;
    record(message);
    return true;
  }

  /// What a test of all messages looks at later.
  void record(const Json &message) const {
    const char *const file = std::getenv(recordVariable);
    if (!file || !message.is_object())
      return;
    EXPECT_EQ(message.value("jsonrpc", ""), "2.0");
    Json line;
    if (message.contains("method")) {
      line = {{"method", message["method"]}, {"part", "params"}};
    } else if (message.contains("result") && message["id"].is_number_integer()) {
      const auto asked = asked_.find(message["id"].get<int64_t>());
      if (asked == asked_.end())
        return;
      line = {{"method", asked->second}, {"part", "result"}};
    } else {
      return;
    }
    const std::string part = line["part"];
    if (message.contains(part))
      std::ofstream(file, std::ios::app)
          << Json{{"method", line["method"]}, {"part", part}, {"value", message[part]}} << "\n";
  }

  int64_t lastId_ = 0;
  std::map<int64_t, std::string> asked_; ///< methods of requests
  std::deque<Json> kept_;
};

/// Offset-free positions for parameters.
inline Json at(unsigned line, unsigned character) {
  return {{"line", line}, {"character", character}};
}
inline Json documentOf(const std::string &path) { return {{"uri", "file://" + path}}; }

} // namespace ncvet::test
