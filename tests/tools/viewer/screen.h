#pragma once

#include <sys/types.h>

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace graben::test {

/// What a screen shows.
struct Shot {
  using Color = std::array<int, 3>;

  int width = 0;
  int height = 0;
  std::vector<Color> pixels; ///< row by row from the top

  /// Share of the pixels that are not black; of the outermost ones only with \a border.
  double covered(bool border = false) const;
  /// The colours that are not black or grey, as captions are.
  std::set<Color> colors() const;
  /// The two colours that most pixels have, and their share of all that are not black.
  std::pair<std::set<Color>, double> mostOfTwo() const;
  void save(const std::string& png) const;
};

/// An X server without a display, and pcl_viewer on it.
class ViewerScreen {
public:
  /// \param[in] folder to run in
  explicit ViewerScreen(std::string folder);
  ~ViewerScreen();
  ViewerScreen(const ViewerScreen&) = delete;
  ViewerScreen& operator=(const ViewerScreen&) = delete;

  /// Why there is nothing to see: Xvfb or pcl_viewer is missing; empty if neither is.
  static std::string missing();

  /// Starts the viewer and waits until it shows something and no longer changes; a former one is ended.
  Shot view(const std::string& arguments);
  /// What is shown after a key was pressed.
  Shot press(char key);

private:
  Shot shot() const;
  Shot settled() const;
  void endViewer();

  std::string folder_;
  std::string display_;
  pid_t server_ = -1;
  pid_t viewer_ = -1;
};

} // namespace graben::test
