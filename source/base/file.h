// Files written whole or not at all, read whole, or grown by one line.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace strandlab {

/// All bytes of a file. Throws Error (bad_input) with path and reason.
std::string read_file(const std::string& path);

/// Writes a new file beside the wanted one and puts it in its place on commit (fsync, then rename), so
/// that nobody ever sees half a file: without commit, or after an error, the old file is untouched and
/// nothing is left behind. Symbolic links are followed; devices and pipes are written directly. Every
/// error (no such folder, no permission, disk full) throws Error (bad_input) with path and reason.
class FileWriter {
  public:
    explicit FileWriter(const std::string& path);
    ~FileWriter();
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    void write(const void* data, size_t bytes);
    void write(std::string_view text) { write(text.data(), text.size()); }

    /// Makes what was written the file. Call once, last.
    void commit();

  private:
    [[noreturn]] void fail_to_write(int error) const;

    std::string path_;       // as the caller named it
    std::string target_;     // behind symbolic links
    std::string temporary_;  // empty when writing to a device or pipe, or when done
    int descriptor_ = -1;
};

/// Writes a whole file with FileWriter.
void write_file(const std::string& path, std::string_view bytes);

/// Throws as append_line would where the file or its folder does not allow it: before hours of work whose
/// rows it is for. Creates nothing.
void check_appendable(const std::string& path);

/// Cuts off the last line of a file when it lacks its newline and is not whole (which the caller judges): its
/// writer was interrupted. Returns whether there was one. No file: nothing to do. Takes append_line's lock.
bool drop_torn_line(const std::string& path, const std::function<bool(std::string_view line)>& is_whole);

/// Appends one line (the newline is added) with a single write under a lock, so that rows of several
/// processes never mix; a last line that lacks its newline is completed first. first_line, where there is
/// one, goes before it into a file that is empty. Creates the file when missing. On an error the file is as
/// before.
void append_line(const std::string& path, std::string_view line, std::string_view first_line = {});

}  // namespace strandlab
