// JSON-RPC 2.0 over a message stream: methods by name, answers, cancellation.
#pragma once

#include "formats/text/json_text.h"
#include "lsp/transport/message_stream.h"

#include "llvm/ADT/StringMap.h"
#include "llvm/ADT/Twine.h"
#include <nlohmann/json.hpp>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace ncvet::lsp {

using Json = nlohmann::json;

/// Error codes of JSON-RPC and of the language server protocol.
enum class RpcError : int {
  ParseError = -32700,
  InvalidRequest = -32600,
  MethodNotFound = -32601,
  InvalidParams = -32602,
  InternalError = -32603,
  ServerNotInitialized = -32002,
  RequestCancelled = -32800,
  ContentModified = -32801,
  RequestFailed = -32803
};

class Rpc;

/// What is known of a request that was not answered yet.
struct OpenRequest {
  Json id;
  std::atomic<bool> cancelled = false, answered = false;
};

/// The answer to one request: given once, from any thread. When it is dropped without one, the
/// client is told that the request failed: no request stays open.
class Reply {
public:
  Reply(Rpc &rpc, std::shared_ptr<OpenRequest> request)
      : rpc_(&rpc), request_(std::move(request)) {}
  Reply(Reply &&other) noexcept
      : rpc_(std::exchange(other.rpc_, nullptr)), request_(std::move(other.request_)) {}
  Reply &operator=(Reply &&) = delete;
  ~Reply();

  void operator()(Json result);
  /// The same with a result that is text already.
  void text(llvm::StringRef result);
  void fail(RpcError code, const llvm::Twine &why);
  /// Set when the client no longer wants the answer.
  const std::atomic<bool> &cancelled() const { return request_->cancelled; }

private:
  void send(llvm::StringRef member, Json value);

  Rpc *rpc_;
  std::shared_ptr<OpenRequest> request_;
};

/// Binds methods to functions. `handle` belongs to one thread; answers, notifications and requests
/// to the client may be sent from any.
class Rpc {
public:
  using RequestHandler = std::function<void(const Json &params, Reply reply)>;
  using NotificationHandler = std::function<void(const Json &params)>;
  using AnswerHandler = std::function<void(const Json &result, bool failed)>;
  /// What to do with a request before its handler: true when it has been dealt with.
  using Gate = std::function<bool(llvm::StringRef method, Reply &reply)>;

  explicit Rpc(MessageWriter &writer) : writer_(writer) {}

  void onRequest(llvm::StringRef method, RequestHandler handler) {
    requests_[method] = std::move(handler);
  }
  void onNotification(llvm::StringRef method, NotificationHandler handler) {
    notifications_[method] = std::move(handler);
  }
  /// Those that are bound, in alphabetical order.
  std::vector<std::string> requestMethods() const;
  void setGate(Gate gate) { gate_ = std::move(gate); }

  /// Takes one message. Never fails: what is wrong with it is answered.
  void handle(llvm::StringRef body);
  /// Tells the client of a message that could not be read.
  void complain(RpcError code, const llvm::Twine &why);

  void notify(llvm::StringRef method, Json params);
  /// The same with parameters that are text already.
  void notifyText(llvm::StringRef method, llvm::StringRef params);
  /// Asks the client; `answer` is called on the thread of `handle`.
  void request(llvm::StringRef method, Json params, AnswerHandler answer);

private:
  friend class Reply;
  void send(const Json &message);
  void take(const Json &message);
  void takeRequest(llvm::StringRef method, const Json &id, const Json &params);
  void takeAnswer(const Json &message);
  void finished(const std::string &id);

  MessageWriter &writer_;
  llvm::StringMap<RequestHandler> requests_;
  llvm::StringMap<NotificationHandler> notifications_;
  Gate gate_;
  std::mutex mutex_;                                            ///< of what follows
  std::map<std::string, std::shared_ptr<OpenRequest>> running_; ///< by id
  std::map<int64_t, AnswerHandler> asked_;
  int64_t lastAsked_ = 0;
};

} // namespace ncvet::lsp
