// How far a long request is, for clients that want to know, and answers in parts.
#pragma once

#include "lsp/transport/rpc.h"

namespace ncvet::lsp {

/// Tells the client of a request's begin, of its progress and of its end.
class WorkDone {
public:
  /// `params` of the request: without a token nothing is told.
  WorkDone(Rpc &rpc, const Json &params, llvm::StringRef title);
  WorkDone(const WorkDone &) = delete;
  ~WorkDone();

  /// So many of `all` pieces are done.
  void report(size_t done, size_t all);

private:
  void tell(Json value);

  Rpc &rpc_;
  Json token_;
  size_t percent_ = 0; ///< that was told last
};

/// Sends pieces of an answer that is a list, before the rest of it.
class PartialAnswer {
public:
  /// `params` of the request: without a token nothing is sent.
  PartialAnswer(Rpc &rpc, const Json &params);

  bool isWanted() const { return !token_.is_null(); }
  void send(Json part);

private:
  Rpc &rpc_;
  Json token_;
};

} // namespace ncvet::lsp
