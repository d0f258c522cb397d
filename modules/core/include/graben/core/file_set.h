#pragma once

#include "graben/core/errors.h"
#include "graben/core/export.h"
#include "graben/core/unfinished_files.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a FileSet is told from other files of its folder by.
struct FileSetNames {
  std::string manifest;   ///< the file that lists all files of the set, one a line, for the next set to know its own
  std::string seal;       ///< the file of the set that is put in place last: where it is whole, the set is
  std::string incomplete; ///< what the seal holds while files are being exchanged
};

/// Files that are kept in a folder and in folders below it, beside those of its owner, and are replaced all at once.
///
/// The files are written into a new folder, staging(), in the folder itself; commit() puts them in place of the former set, in milliseconds. Until then,
/// and if it is never called, the former set stands as it was. Of what the folder held before, only regular files that the former set's manifest names
/// are ever replaced or removed. Ended in the middle of commit(), the seal says so; the next set puts it right.
class FileSet {
public:
  /// Makes the folder, with those above it, where it is not there.
  /// \throw WriteError if that cannot be done
  FileSet(const std::string& folder, FileSetNames names);
  /// Removes what was not committed, and the folders that were made for it.
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// The folder to write the files to, under their final names; folders may be made in it.
  const std::string& staging() const { return staging_->path(); }

  /// Exchanges the former set for what lies in staging().
  /// \return the names of the files now in place, seen from the folder (`blocks/a.ply`), in order of the alphabet
  /// \throw WriteError if a file would take the place of one that no former set names: then nothing was exchanged; or if a file cannot be renamed
  std::vector<std::string> commit();

  /// An error about a file in staging(), told of the place it was to have.
  WriteError inPlace(const IoError& error) const;

  /// The names of the set that \a folder holds; empty if it holds none.
  static std::set<std::string> namesIn(const std::string& folder, const FileSetNames& names);

  /// Those of \a wanted that stand in \a folder and belong to no set, so that commit() would refuse.
  static std::vector<std::string> notOfTheSet(const std::string& folder, const FileSetNames& names, const std::vector<std::string>& wanted);

private:
  void removeLeftovers() const;

  std::string told_folder_;
  std::string folder_;
  FileSetNames names_;
  std::vector<std::string> made_; ///< folders that were not there, the innermost last
  std::optional<UnfinishedFile> staging_;
  bool committed_ = false;
};

/// Finds out whether files could be written to \a folder, or to the one it would be made in.
/// \throw WriteError if not
void checkFolderWritable(const std::string& folder);

} // namespace graben
GRABEN_EXPORT_END
