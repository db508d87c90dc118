// The path of the tool, for a view beside the text: `ncvet/path`.
#include "formats/text/crash_guard.h"
#include "lsp/server/bindings.h"
#include "lsp/server/live_paths.h"

namespace ncvet::lsp {

void bindPaths(Context &context) {
  context.rpc.onRequest("ncvet/path", [&context](const Json &params, Reply reply) {
    const std::string uri = params.at("textDocument").at("uri");
    const Document *document = context.documents.find(uri);
    if (!document)
      return reply.fail(RpcError::InvalidParams, "the document is not open: " + uri);
    auto held = std::make_shared<Reply>(std::move(reply));
    context.paths->post(
        [&context, held, job = context.job(*document),
         wish = PathWish{params.value("previous", ""), params.value("pieces", false)}] {
          if (held->cancelled())
            return held->fail(RpcError::RequestCancelled, "cancelled");
          const auto crash = runGuarded([&] {
            auto answer = context.livePaths->answer(job, wish, held->cancelled());
            if (answer)
              held->text(*answer);
            else
              held->fail(RpcError::RequestFailed, llvm::toString(answer.takeError()));
          });
          if (!crash)
            return;
          context.log(job.document.path + ": a path failed: " + *crash);
          context.livePaths->abandon(job.document.path);
          held->fail(RpcError::InternalError, "the request failed: " + *crash);
        });
  });
}

} // namespace ncvet::lsp
