#include "scenes/private_x_server.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace graben {
namespace {

constexpr int kStartTries = 3; // servers that start at the same moment may fight over one display number
constexpr auto kStartTimeout = std::chrono::seconds(30);
constexpr auto kStopTimeout = std::chrono::seconds(5);

std::string findProgram(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = folder + "/" + name;
    if (access(file.c_str(), X_OK) == 0)
      return file;
  }
  return {};
}

/// In the child: only calls that are safe after fork in a program with threads.
[[noreturn]] void becomeServer(const char* program, const char* display_fd, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr); // the program may wait for signals in a thread of its own
  if (getppid() != parent)
    _exit(1);
  const int null = open("/dev/null", O_RDWR);
  dup2(null, STDIN_FILENO);
  dup2(null, STDOUT_FILENO);
  dup2(null, STDERR_FILENO);
  execl(program, "Xvfb", "-displayfd", display_fd, "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset",
        "+extension", "GLX", static_cast<char*>(nullptr));
  _exit(127);
}

/// Reads "<number>\n"; empty if the other end closed first or time ran out.
std::string readDisplayNumber(int fd) {
  const auto deadline = std::chrono::steady_clock::now() + kStartTimeout;
  std::string number;
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    pollfd waiting{fd, POLLIN, 0};
    const int ready = left > 0 ? poll(&waiting, 1, static_cast<int>(left)) : 0;
    if (ready < 0 && errno == EINTR)
      continue;
    char c = 0;
    if (ready <= 0 || read(fd, &c, 1) != 1)
      return {};
    if (c == '\n')
      return number;
    number += c;
  }
}

} // namespace

PrivateXServer::PrivateXServer() {
  for (int i = 0; i < kStartTries && display_.empty(); ++i)
    start();
}

PrivateXServer::~PrivateXServer() { stop(); }

void PrivateXServer::start() {
  const std::string program = findProgram("Xvfb");
  if (program.empty()) {
    error_ = "there is no X display and no Xvfb; install the package xvfb or set DISPLAY";
    return;
  }
  std::array<int, 2> channel{};
  if (pipe2(channel.data(), O_CLOEXEC) != 0) {
    error_ = "no pipe to Xvfb could be made";
    return;
  }
  const std::string display_fd = std::to_string(channel[1]);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {
    fcntl(channel[1], F_SETFD, 0); // this end must survive exec
    becomeServer(program.c_str(), display_fd.c_str(), parent);
  }
  close(channel[1]);
  const std::string number = process_ > 0 ? readDisplayNumber(channel[0]) : std::string();
  close(channel[0]);
  if (number.empty()) {
    stop();
    error_ = program + " did not start; try it by hand: Xvfb :99";
    return;
  }
  display_ = ":" + number;
  error_.clear();
}

void PrivateXServer::stop() {
  if (process_ <= 0)
    return;
  kill(process_, SIGTERM);
  const auto deadline = std::chrono::steady_clock::now() + kStopTimeout;
  while (waitpid(process_, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process_ = -1;
  display_.clear();
}

} // namespace graben
