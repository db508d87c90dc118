// A client of the debug adapter in a test: the real binary, spoken to message by message.
#pragma once

#include "tests/support/message_process.h"
#include "tests/support/places.h"

#include <cstdlib>
#include <deque>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <vector>

namespace ncvet::test {

/// Names a file to which clients add what the adapter sends, one message a line.
inline constexpr const char *debugRecordVariable = "NCVET_TEST_DEBUG_MESSAGES";

/// Starts `ncvet dap` and talks to it. What does not come in time is a failure of the test and
/// reads as null.
class DebugClient : public MessageProcess {
public:
  DebugClient() : MessageProcess(places::program(), "dap") {}

  int64_t ask(const std::string &command, Json arguments = Json::object()) {
    send({{"seq", ++lastSeq_},
          {"type", "request"},
          {"command", command},
          {"arguments", std::move(arguments)}});
    return lastSeq_;
  }
  /// The whole response to a request.
  Json response(int64_t seq) {
    return next([seq](const Json &message) {
      return message.value("type", "") == "response" && message.value("request_seq", 0) == seq;
    });
  }
  /// The body of the response; a failed one is a failure of the test.
  Json request(const std::string &command, Json arguments = Json::object()) {
    const Json message = response(ask(command, std::move(arguments)));
    EXPECT_TRUE(message.is_object() && message.value("success", false))
        << command << ": " << message.dump();
    return message.is_object() ? message.value("body", Json()) : Json();
  }
  /// The message of a request that fails.
  std::string refusal(const std::string &command, Json arguments = Json::object()) {
    const Json message = response(ask(command, std::move(arguments)));
    EXPECT_FALSE(message.value("success", true)) << message.dump();
    return message.value("message", "");
  }
  /// The body of the next event of this name.
  Json event(const std::string &name) {
    const Json message = next([&](const Json &m) { return m.value("event", "") == name; });
    return message.is_object() ? message.value("body", Json::object()) : Json();
  }
  /// The body of the next event of one of these names.
  Json eventOf(const std::set<std::string> &names) {
    const Json message = next([&](const Json &m) { return names.count(m.value("event", "")) > 0; });
    return message.is_object() ? message.value("body", Json::object()) : Json();
  }
  /// `initialize` and `launch`, up to where breakpoints may be set.
  void launch(Json arguments) {
    request("initialize", {{"adapterID", "ncvet"}});
    request("launch", std::move(arguments));
    event("initialized");
  }
  /// The run begins; where it stops first.
  Json begin() {
    request("configurationDone");
    return event("stopped");
  }
  /// Sends the run on; why it stops.
  Json go(const std::string &command) {
    request(command, {{"threadId", 1}});
    return event("stopped");
  }
  /// The line of the innermost frame.
  int line() { return frames()[0]["line"].get<int>(); }
  Json frames() { return request("stackTrace", {{"threadId", 1}})["stackFrames"]; }
  /// Values of one scope of the innermost frame, by name.
  std::map<std::string, std::string> scope(const std::string &name) {
    std::map<std::string, std::string> values;
    const Json scopes = request("scopes", {{"frameId", frames()[0]["id"]}});
    for (const Json &one : scopes["scopes"]) {
      if (one["name"] != name)
        continue;
      const Json body = request("variables", {{"variablesReference", one["variablesReference"]}});
      for (const Json &variable : body["variables"])
        values[variable["name"]] = variable["value"];
    }
    return values;
  }
  std::string evaluate(const std::string &expression, const std::string &context = "watch") {
    return request("evaluate", {{"expression", expression}, {"context", context}})["result"];
  }
  int disconnect() {
    request("disconnect");
    return exitCode();
  }
  /// All that was output so far, but for what was asked for by `event`.
  std::string outputs() const {
    std::string all;
    for (const Json &message : kept_)
      if (message.value("event", "") == "output")
        all += message["body"]["output"].get<std::string>();
    return all;
  }

  /// Bodies of the outputs of a category so far; they are not given again.
  std::vector<Json> takeOutputs(const std::string &category) {
    std::vector<Json> bodies;
    std::erase_if(kept_, [&](const Json &message) {
      const bool is = message.value("event", "") == "output" &&
                      message["body"].value("category", "") == category;
      if (is)
        bodies.push_back(message["body"]);
      return is;
    });
    return bodies;
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
    while (receive(message)) {
      record(message);
      if (wanted(message))
        return message;
      kept_.push_back(std::move(message));
    }
    ADD_FAILURE() << "the message that was waited for did not come";
    return nullptr;
  }

  /// Numbers of messages go up by one; what a test of all messages looks at later is kept.
  void record(const Json &message) {
    EXPECT_EQ(message.value("seq", 0), ++lastReceived_);
    if (const char *const file = std::getenv(debugRecordVariable))
      std::ofstream(file, std::ios::app) << message.dump() << "\n";
  }

  int64_t lastSeq_ = 0, lastReceived_ = 0;
  std::deque<Json> kept_;
};

} // namespace ncvet::test
