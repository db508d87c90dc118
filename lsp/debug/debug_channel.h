// The Debug Adapter Protocol over a message stream: commands by name, responses, events.
#pragma once

#include "lsp/transport/message_stream.h"

#include "llvm/ADT/StringMap.h"
#include "llvm/Support/Error.h"
#include <nlohmann/json.hpp>

#include <atomic>
#include <functional>
#include <vector>

namespace ncvet::dap {

using Json = nlohmann::json;

/// The text of an error that no user is told of: the client may ask again when the program waits.
inline constexpr llvm::StringLiteral notStopped = "notStopped";

/// Binds commands to functions. `handle` belongs to one thread; events may be sent from any.
class DebugChannel {
public:
  /// Gives the body of the response; null: it has none. An error is one that the user reads. Wrong
  /// arguments may throw `Json::exception`, which becomes an error too.
  using Handler = std::function<llvm::Expected<Json>(const Json &arguments)>;

  explicit DebugChannel(lsp::MessageWriter &writer) : writer_(writer) {}

  void on(llvm::StringRef command, Handler handler) { handlers_[command] = std::move(handler); }
  /// What a handler does after its response has been sent: what it sets going may send events.
  void afterResponse(std::function<void()> work) { later_.push_back(std::move(work)); }
  /// Takes one message. Never fails: what is wrong with it is answered.
  void handle(llvm::StringRef body);
  void event(llvm::StringRef name, Json body = nullptr);
  /// Tells the client of something that no request asks for, as output.
  void complain(llvm::StringRef why);

private:
  llvm::Expected<Json> answer(const std::string &command, const Json &arguments);
  void send(Json message);

  lsp::MessageWriter &writer_;
  llvm::StringMap<Handler> handlers_;
  std::vector<std::function<void()>> later_;
  std::mutex mutex_; ///< numbers of messages go up in the order in which they are sent
  int64_t lastSent_ = 0;
};

} // namespace ncvet::dap
