//! Where output goes.

use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{fs, iter};

use crate::error::{Error, reason};

/// A place to write to, checked before any work and written to at its end. In between there is
/// nothing of it in the file system: whoever interrupts the work finds things as they were.
#[derive(Debug)]
pub(crate) struct Output {
    /// The name that the user gave, for messages.
    path: PathBuf,
    place: Place,
}

#[derive(Debug)]
enum Place {
    Stdout,
    /// A file, there or not: written beside its place and renamed when it is complete.
    File(PathBuf),
    /// What is no file (a device, a pipe) cannot be renamed to.
    Stream(fs::File),
}

impl Output {
    /// Makes sure that it can be written: what is there stays as it is until [`Output::write`].
    pub(crate) fn open(path: &Path) -> Result<Output, Error> {
        let place = place(path).map_err(|source| Error::Write { path: path.into(), source })?;
        Ok(Output { path: path.into(), place })
    }

    /// Writes all of it, or leaves what was there.
    pub(crate) fn write(self, bytes: &[u8]) -> Result<(), Error> {
        let written = match self.place {
            Place::Stdout => return to_stdout(bytes),
            Place::Stream(mut stream) => stream.write_all(bytes),
            Place::File(target) => replace(&target, bytes),
        };
        written.map_err(|source| Error::Write { path: self.path, source })
    }

    /// The file to be, if it is one: as the user names it, unless that is a link to it.
    pub(crate) fn file(&self) -> Option<&Path> {
        match &self.place {
            Place::File(target) if self.path.is_symlink() => Some(target),
            Place::File(_) => Some(&self.path),
            Place::Stdout | Place::Stream(_) => None,
        }
    }

    /// Whether the one would overwrite, or run into, the other.
    pub(crate) fn is_same(&self, other: &Output) -> bool {
        match (&self.place, &other.place) {
            (Place::Stdout, Place::Stdout) => true,
            (Place::File(one), Place::File(other)) => one == other,
            _ => false,
        }
    }
}

/// The format that a file's extension names; without one, the first of those known.
pub(crate) fn format(path: &Path, known: &'static [&'static str]) -> Result<&'static str, Error> {
    let Some(extension) = path.extension() else { return Ok(known[0]) };
    let named = |format: &&&str| extension.eq_ignore_ascii_case(OsStr::new(format));
    let format = known.iter().find(named).copied();
    format.ok_or_else(|| Error::OutputFormat { path: path.into(), known })
}

/// Writes data to standard output. A reader that has gone away is no error.
pub(crate) fn to_stdout(bytes: &[u8]) -> Result<(), Error> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::Write { path: "standard output".into(), source: error })
        }
        _ => Ok(()),
    }
}

/// The bytes of a regular file. (A pipe or a device might never end.)
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, Error> {
    let read = || {
        let kind = fs::metadata(path)?.file_type();
        match kind.is_file() {
            true => fs::read(path),
            false if kind.is_dir() => Err(io::Error::other("it is a directory")),
            false => Err(io::Error::other("it is not a regular file")),
        }
    };
    read().map_err(|source| Error::Read { path: path.into(), source })
}

fn place(path: &Path) -> io::Result<Place> {
    if path == Path::new("-") {
        return Ok(Place::Stdout);
    }
    let target = match fs::metadata(path) {
        Ok(facts) if facts.is_dir() => return Err(io::Error::other("it is a directory")),
        Ok(facts) if facts.is_file() && facts.permissions().readonly() => {
            return Err(io::Error::other("it is read-only"));
        }
        Ok(facts) => {
            // This changes nothing of a file; of a pipe it waits for the reader.
            let there = fs::OpenOptions::new().write(true).open(path)?;
            if !facts.is_file() {
                return Ok(Place::Stream(there));
            }
            // Through links: the file that a link names is replaced, not the link.
            fs::canonicalize(path)?
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => new_file(path)?,
        Err(error) => return Err(error),
    };
    let folder = folder(&target);
    // A file without a name, which is gone when it is closed, or killed.
    tempfile::tempfile_in(folder).map_err(|error| {
        let why = format!("no file can be made in {}: {}", folder.display(), reason(&error));
        io::Error::new(error.kind(), why)
    })?;
    Ok(Place::File(target))
}

/// The full name of a file that is yet to be made, through links that are there already.
fn new_file(path: &Path) -> io::Result<PathBuf> {
    // The links come to an end: the system has followed them and found nothing there.
    let follow = |path: &PathBuf| Some(folder(path).join(fs::read_link(path).ok()?));
    let target = iter::successors(Some(path.to_owned()), follow).last().unwrap_or_default();
    let names_folder = path.as_os_str().as_encoded_bytes().ends_with(b"/");
    let folder = if names_folder { path } else { folder(&target) };
    match (fs::canonicalize(folder), target.file_name()) {
        (Ok(folder), Some(name)) => Ok(folder.join(name)),
        _ => Err(io::Error::other(format!("there is no folder {}", folder.display()))),
    }
}

/// The folder that a file is in.
fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Puts a complete file in a place: what is there is replaced in one step, or stays.
fn replace(target: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".rt-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any new file, under the umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    // Removed when it is dropped: on every way out but the last.
    let mut temporary = builder.tempfile_in(folder(target))?;
    temporary.write_all(bytes)?;
    if let Ok(there) = fs::metadata(target) {
        temporary.as_file().set_permissions(there.permissions())?;
    }
    temporary.persist(target).map_err(|error| error.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_vanishes_meanwhile_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let output = Output::open(&folder.path().join("a.png")).unwrap();
        fs::remove_dir(folder.path()).unwrap();
        let error = output.write(b"picture").unwrap_err().to_string();
        assert!(error.starts_with("cannot write ") && !error.contains("os error"), "{error}");
    }

    #[test]
    fn a_file_is_nowhere_to_be_seen_until_it_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let entries = || fs::read_dir(folder.path()).unwrap().count();
        let output = Output::open(&folder.path().join("a.png")).unwrap();
        assert_eq!(entries(), 0);
        output.write(b"picture").unwrap();
        assert_eq!(entries(), 1);
    }

    #[test]
    fn extensions_tell_formats() {
        let known = &["nff", "obj"];
        for (path, format) in [("a.NFF", "nff"), ("a.obj", "obj"), ("a", "nff"), ("-", "nff")] {
            assert_eq!(super::format(Path::new(path), known).unwrap(), format);
        }
        let error = super::format(Path::new("a.png"), known).unwrap_err().to_string();
        assert_eq!(error, "cannot write a.png: give it the extension .nff or .obj");
    }
}
