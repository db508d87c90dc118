// The Debug Adapter Protocol over a message stream: takes requests apart, and puts answers
// together.
#include "lsp/debug/debug_channel.h"

#include "formats/text/failure.h"
#include "formats/text/json_text.h"
#include "lsp/transport/json_message.h"

namespace ncvet::dap {

void DebugChannel::send(Json message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  message["seq"] = ++lastSent_;
  writer_.write(jsonText(message));
}

void DebugChannel::event(llvm::StringRef name, Json body) {
  Json message = {{"type", "event"}, {"event", name.str()}};
  if (!body.is_null())
    message["body"] = std::move(body);
  send(std::move(message));
}

void DebugChannel::complain(llvm::StringRef why) {
  event("output", {{"category", "stderr"}, {"output", "ncvet: " + why.str() + "\n"}});
}

llvm::Expected<Json> DebugChannel::answer(const std::string &command, const Json &arguments) {
  const auto handler = handlers_.find(command);
  if (handler == handlers_.end())
    return failure("there is no command " + command);
  try {
    return handler->second(arguments);
  } catch (const Json::exception &) {
    return failure("the arguments of " + command + " are wrong");
  }
}

void DebugChannel::handle(llvm::StringRef body) {
  const Json message = lsp::parseMessage(body);
  if (!message.is_object())
    return complain("a message that is no JSON object");
  const auto text = [&](const char *name) {
    const auto found = message.find(name);
    return found != message.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto seq = message.find("seq");
  if (text("type") == "response") // no request of the client's is open
    return;
  if (text("type") != "request" || seq == message.end() || !seq->is_number_integer() ||
      text("command").empty())
    return complain("a message that is no request");
  const std::string command = text("command");
  const auto given = message.find("arguments");
  const Json arguments = given != message.end() && given->is_object() ? *given : Json::object();
  llvm::Expected<Json> answered = answer(command, arguments);
  Json response = {{"type", "response"}, {"request_seq", *seq}, {"command", command}};
  response["success"] = bool(answered);
  if (!answered) {
    const std::string why = llvm::toString(answered.takeError());
    response["message"] = why;
    response["body"] = {{"error",
                         {{"id", 1},
                          {"format", "{why}"},
                          {"variables", {{"why", why}}},
                          {"showUser", why != notStopped}}}};
    later_.clear();
  } else if (!answered->is_null()) {
    response["body"] = std::move(*answered);
  }
  send(std::move(response));
  for (const auto &work : std::exchange(later_, {}))
    work();
}

} // namespace ncvet::dap
