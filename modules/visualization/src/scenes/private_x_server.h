#pragma once

#include <string>

#include <sys/types.h>

namespace graben {

/// An Xvfb of our own on a display number that it finds free itself.
class PrivateXServer {
public:
  /// Starts the server and waits until it takes connections; on failure error() says why.
  PrivateXServer();
  ~PrivateXServer();
  PrivateXServer(const PrivateXServer&) = delete;
  PrivateXServer& operator=(const PrivateXServer&) = delete;

  const std::string& display() const { return display_; } ///< such as ":5"; empty on failure
  const std::string& error() const { return error_; }

private:
  void start();
  void stop();

  pid_t process_ = -1;
  std::string display_;
  std::string error_;
};

} // namespace graben
