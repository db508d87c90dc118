// JSON-RPC: takes messages apart, and puts answers together.
#include "lsp/transport/rpc.h"

#include "lsp/transport/json_message.h"

#include <algorithm>
#include <exception>

namespace ncvet::lsp {

namespace {

const Json nothing;

const Json &member(const Json &object, const char *name) {
  const auto found = object.find(name);
  return found == object.end() ? nothing : *found;
}

bool isId(const Json &id) { return id.is_number_integer() || id.is_string(); }

} // namespace

Reply::~Reply() {
  // While an exception unwinds, whoever catches it answers.
  if (rpc_ && std::uncaught_exceptions() == 0)
    fail(RpcError::InternalError, "the request was not answered");
}

void Reply::send(llvm::StringRef member, Json value) {
  Rpc *rpc = std::exchange(rpc_, nullptr);
  if (!rpc || request_->answered.exchange(true))
    return;
  rpc->finished(jsonText(request_->id));
  rpc->send({{"jsonrpc", "2.0"}, {"id", request_->id}, {member.str(), std::move(value)}});
}

void Reply::operator()(Json result) {
  if (request_->cancelled)
    fail(RpcError::RequestCancelled, "cancelled");
  else
    send("result", std::move(result));
}

void Reply::text(llvm::StringRef result) {
  if (request_->cancelled)
    return fail(RpcError::RequestCancelled, "cancelled");
  Rpc *rpc = std::exchange(rpc_, nullptr);
  if (!rpc || request_->answered.exchange(true))
    return;
  const std::string id = jsonText(request_->id);
  rpc->finished(id);
  rpc->writer_.write((R"({"jsonrpc":"2.0","id":)" + id + R"(,"result":)" + result + "}").str());
}

void Reply::fail(RpcError code, const llvm::Twine &why) {
  send("error", {{"code", int(code)}, {"message", why.str()}});
}

void Rpc::send(const Json &message) { writer_.write(jsonText(message)); }

void Rpc::complain(RpcError code, const llvm::Twine &why) {
  send({{"jsonrpc", "2.0"},
        {"id", nullptr},
        {"error", {{"code", int(code)}, {"message", why.str()}}}});
}

void Rpc::notify(llvm::StringRef method, Json params) {
  Json message = {{"jsonrpc", "2.0"}, {"method", method.str()}};
  if (!params.is_null())
    message["params"] = std::move(params);
  send(message);
}

void Rpc::notifyText(llvm::StringRef method, llvm::StringRef params) {
  const std::string name = jsonText(Json(method.str()));
  writer_.write((R"({"jsonrpc":"2.0","method":)" + name + R"(,"params":)" + params + "}").str());
}

void Rpc::request(llvm::StringRef method, Json params, AnswerHandler answer) {
  Json message = {{"jsonrpc", "2.0"}, {"method", method.str()}};
  if (!params.is_null())
    message["params"] = std::move(params);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    message["id"] = ++lastAsked_;
    asked_[lastAsked_] = std::move(answer);
  }
  send(message);
}

void Rpc::finished(const std::string &id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  running_.erase(id);
}

std::vector<std::string> Rpc::requestMethods() const {
  std::vector<std::string> methods;
  for (const auto &request : requests_)
    methods.push_back(request.getKey().str());
  std::sort(methods.begin(), methods.end());
  return methods;
}

void Rpc::handle(llvm::StringRef body) {
  if (nestsTooDeep(body))
    return complain(RpcError::ParseError, "the message nests too deep");
  const Json message = parseMessage(body);
  if (message.is_discarded())
    return complain(RpcError::ParseError, "the message is no JSON");
  if (!message.is_object())
    return complain(RpcError::InvalidRequest, "the message is no object");
  take(message);
}

void Rpc::take(const Json &message) {
  const Json &method = member(message, "method");
  const Json &id = member(message, "id");
  if (method.is_null()) {
    if (message.contains("result") || message.contains("error"))
      return takeAnswer(message);
    return complain(RpcError::InvalidRequest, "the message has no method");
  }
  if (!method.is_string() || !(id.is_null() || isId(id)))
    return complain(RpcError::InvalidRequest, "a method is a string, an id a number or a string");
  const std::string name = method;
  const Json &params = member(message, "params");
  if (!id.is_null())
    return takeRequest(name, id, params);
  if (name == "$/cancelRequest") {
    const Json &which = params.is_object() ? member(params, "id") : nothing;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto running = running_.find(jsonText(which));
    if (running != running_.end())
      running->second->cancelled = true;
    return;
  }
  const auto handler = notifications_.find(name);
  if (handler == notifications_.end())
    return; // what is not known may be left aside
  try {
    handler->second(params);
  } catch (const Json::exception &) {
    complain(RpcError::InvalidParams, llvm::Twine("the parameters of ") + name + " are wrong");
  }
}

void Rpc::takeRequest(llvm::StringRef method, const Json &id, const Json &params) {
  auto request = std::make_shared<OpenRequest>();
  request->id = id;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_[jsonText(id)] = request;
  }
  Reply reply(*this, request);
  if (gate_ && gate_(method, reply))
    return;
  const auto handler = requests_.find(method);
  if (handler == requests_.end())
    return reply.fail(RpcError::MethodNotFound, "there is no method " + method);
  try {
    handler->second(params, std::move(reply));
  } catch (const Json::exception &) {
    Reply(*this, request)
        .fail(RpcError::InvalidParams, "the parameters of " + method + " are wrong");
  }
}

void Rpc::takeAnswer(const Json &message) {
  const Json &id = member(message, "id");
  AnswerHandler answer;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto asked = id.is_number_integer() ? asked_.find(id.get<int64_t>()) : asked_.end();
    if (asked == asked_.end())
      return;
    answer = std::move(asked->second);
    asked_.erase(asked);
  }
  if (!answer)
    return;
  try {
    answer(member(message, "result"), message.contains("error"));
  } catch (const Json::exception &) { // the client's answer has another form than was asked for
  }
}

} // namespace ncvet::lsp
