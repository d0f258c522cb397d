#include "screen.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <cairo.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>

namespace graben::test {

namespace {

using namespace std::chrono_literals;

void pause() { std::this_thread::sleep_for(300ms); }

/// Runs a command in a folder through the shell, with DISPLAY set where it is not empty.
pid_t start(const std::string& folder, const std::string& display, const std::string& command) {
  const pid_t child = fork();
  if (child != 0)
    return child;
  if (chdir(folder.c_str()) != 0)
    _exit(127);
  if (!display.empty())
    setenv("DISPLAY", display.c_str(), 1);
  execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
  _exit(127);
}

void end(pid_t& process) {
  if (process <= 0)
    return;
  kill(process, SIGTERM);
  waitpid(process, nullptr, 0);
  process = -1;
}

/// The viewer's window: the one that is not a child's.
Window topWindow(Display* display) {
  Window root = 0, parent = 0, *children = nullptr, found = 0;
  unsigned count = 0;
  if (XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count) != 0 && count > 0)
    found = children[count - 1];
  if (children != nullptr)
    XFree(children);
  return found;
}

void send(Display* display, Window window, char key, int type, long mask) {
  XEvent event;
  std::memset(&event, 0, sizeof event);
  event.xkey.type = type;
  event.xkey.display = display;
  event.xkey.window = window;
  event.xkey.root = DefaultRootWindow(display);
  event.xkey.same_screen = True;
  event.xkey.x = event.xkey.y = 100;
  event.xkey.keycode = XKeysymToKeycode(display, static_cast<KeySym>(static_cast<unsigned char>(key)));
  XSendEvent(display, window, True, mask, &event);
}

} // namespace

double Shot::covered(bool border) const {
  std::size_t there = 0, all = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (border && x > 0 && y > 0 && x + 1 < width && y + 1 < height)
        continue;
      ++all;
      there += pixels[static_cast<std::size_t>(y * width + x)] != Color{0, 0, 0} ? 1U : 0U;
    }
  return all > 0 ? static_cast<double>(there) / static_cast<double>(all) : 0.0;
}

std::set<Shot::Color> Shot::colors() const {
  constexpr int kGray = 12; // channels of greys differ by less
  std::set<Color> found;
  for (const Color& c : pixels)
    if (*std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()) > kGray)
      found.insert(c);
  return found;
}

std::pair<std::set<Shot::Color>, double> Shot::mostOfTwo() const {
  std::map<Color, std::size_t> counts;
  std::size_t all = 0;
  for (const Color& c : pixels)
    if (c != Color{0, 0, 0}) {
      ++counts[c];
      ++all;
    }
  std::vector<std::pair<std::size_t, Color>> ranked;
  for (const auto& [color, count] : counts)
    ranked.emplace_back(count, color);
  std::sort(ranked.rbegin(), ranked.rend());
  ranked.resize(std::min<std::size_t>(ranked.size(), 2));
  std::pair<std::set<Color>, double> most;
  for (const auto& [count, color] : ranked) {
    most.first.insert(color);
    most.second += static_cast<double>(count) / static_cast<double>(all);
  }
  return most;
}

void Shot::save(const std::string& png) const {
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  unsigned char* data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Color& c = pixels[static_cast<std::size_t>(y * width + x)];
      for (int k = 0; k < 3; ++k)
        data[y * stride + 4 * x + k] = static_cast<unsigned char>(c[static_cast<std::size_t>(2 - k)]);
    }
  cairo_surface_mark_dirty(image);
  cairo_surface_write_to_png(image, png.c_str());
  cairo_surface_destroy(image);
}

ViewerScreen::ViewerScreen(std::string folder) : folder_(std::move(folder)) {
  server_ = start(folder_, "", "Xvfb -displayfd 3 -screen 0 1000x800x24 -nolisten tcp 3> display 2> /dev/null");
  for (int i = 0; i < 100 && display_.empty(); ++i) {
    pause();
    std::string number;
    if (std::ifstream(folder_ + "/display") >> number)
      display_ = ":" + number;
  }
  if (display_.empty())
    throw std::runtime_error("Xvfb does not start");
}

ViewerScreen::~ViewerScreen() {
  endViewer();
  end(server_);
}

std::string ViewerScreen::missing() {
  for (const char* program : {"Xvfb", "pcl_viewer"})
    if (std::system(("command -v " + std::string(program) + " > /dev/null").c_str()) != 0)
      return std::string(program) + " is not installed";
  return {};
}

void ViewerScreen::endViewer() { end(viewer_); }

Shot ViewerScreen::shot() const {
  Shot shot;
  Display* display = XOpenDisplay(display_.c_str());
  if (display == nullptr)
    return shot;
  const Window root = DefaultRootWindow(display);
  XWindowAttributes size;
  XGetWindowAttributes(display, root, &size);
  if (XImage* image = XGetImage(display, root, 0, 0, static_cast<unsigned>(size.width), static_cast<unsigned>(size.height), AllPlanes, ZPixmap)) {
    shot.width = size.width;
    shot.height = size.height;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const unsigned long pixel = XGetPixel(image, x, y);
        shot.pixels.push_back({static_cast<int>((pixel >> 16) & 255), static_cast<int>((pixel >> 8) & 255), static_cast<int>(pixel & 255)});
      }
    XDestroyImage(image);
  }
  XCloseDisplay(display);
  return shot;
}

/// The frame rate in the corner changes all the time: what counts is how much is covered.
Shot ViewerScreen::settled() const {
  Shot last;
  for (int i = 0; i < 200; ++i) {
    pause();
    Shot now = shot();
    const bool still = now.covered() > 0.01 && now.colors() == last.colors();
    last = std::move(now);
    if (still && i > 3)
      break;
  }
  return last;
}

Shot ViewerScreen::view(const std::string& arguments) {
  endViewer();
  viewer_ = start(folder_, display_, "pcl_viewer " + arguments + " > viewer.txt 2>&1");
  return settled();
}

Shot ViewerScreen::press(char key) {
  if (Display* display = XOpenDisplay(display_.c_str())) {
    if (const Window window = topWindow(display)) {
      send(display, window, key, KeyPress, KeyPressMask);
      send(display, window, key, KeyRelease, KeyReleaseMask);
    }
    XCloseDisplay(display);
  }
  pause();
  return settled();
}

} // namespace graben::test
