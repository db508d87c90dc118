// A process of ncvet that is spoken to in framed messages, on its standard input and output.
#pragma once

#include "gtest/gtest.h"
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

namespace ncvet::test {

using Json = nlohmann::json;

/// Starts `BINARY COMMAND`; ends it with itself.
class MessageProcess {
public:
  MessageProcess(const std::string &binary, const char *command) {
    int toServer[2], fromServer[2];
    if (::pipe(toServer) || ::pipe(fromServer)) {
      ADD_FAILURE() << "no pipes";
      return;
    }
    ::signal(SIGPIPE, SIG_IGN);
    server_ = ::fork();
    if (server_ == 0) {
      ::dup2(toServer[0], 0);
      ::dup2(fromServer[1], 1);
      for (const int end : {toServer[0], toServer[1], fromServer[0], fromServer[1]})
        ::close(end);
      ::execl(binary.c_str(), binary.c_str(), command, nullptr);
      ::_exit(127);
    }
    ::close(toServer[0]);
    ::close(fromServer[1]);
    in_ = toServer[1];
    out_ = fromServer[0];
  }
  ~MessageProcess() {
    if (server_ > 0) {
      hangUp();
      ::kill(server_, SIGKILL);
      ::waitpid(server_, nullptr, 0);
    }
    ::close(out_);
  }
  MessageProcess(const MessageProcess &) = delete;
  MessageProcess &operator=(const MessageProcess &) = delete;

  void sendBytes(const std::string &bytes) {
    for (size_t at = 0; at < bytes.size();) {
      const ssize_t done = ::write(in_, bytes.data() + at, bytes.size() - at);
      if (done <= 0)
        return;
      at += size_t(done);
    }
  }
  void sendBody(const std::string &body) {
    sendBytes("Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  }
  void send(const Json &message) { sendBody(message.dump()); }

  /// The exit code; -1 when the process did not end in time.
  int exitCode() {
    for (int i = 0; i < 200; ++i) {
      int status = 0;
      if (::waitpid(server_, &status, WNOHANG) == server_) {
        server_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
      }
      ::usleep(50000);
    }
    return -1;
  }
  pid_t process() const { return server_; }
  void hangUp() {
    if (in_ >= 0)
      ::close(in_);
    in_ = -1;
  }

protected:
  /// Reads one message; false at the end or when none comes for half a minute.
  bool receive(Json &message) {
    constexpr int patience = 30000; // ms
    while (true) {
      const size_t header = buffer_.find("\r\n\r\n");
      if (header != std::string::npos) {
        const size_t length = std::stoul(buffer_.substr(buffer_.find(':') + 1));
        if (buffer_.size() >= header + 4 + length) {
          message = Json::parse(buffer_.substr(header + 4, length), nullptr, false);
          buffer_.erase(0, header + 4 + length);
          return true;
        }
      }
      pollfd wait{out_, POLLIN, 0};
      char piece[65536];
      const ssize_t got = ::poll(&wait, 1, patience) > 0 ? ::read(out_, piece, sizeof piece) : 0;
      if (got <= 0)
        return false;
      buffer_.append(piece, size_t(got));
    }
  }

private:
  pid_t server_ = 0;
  int in_ = -1, out_ = -1;
  std::string buffer_;
};

} // namespace ncvet::test
