//! Where output goes.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{env, fs};

use tempfile::NamedTempFile;

use crate::error::Error;

/// A place to write to, checked before any work and written to at its end.
pub(crate) struct Output {
    /// The name that the user gave, for messages.
    path: PathBuf,
    place: Place,
}

enum Place {
    Stdout,
    /// A file that is written beside its place and renamed when it is complete.
    File {
        temporary: NamedTempFile,
        target: PathBuf,
    },
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
            Place::File { mut temporary, target } => temporary
                .write_all(bytes)
                .and_then(|()| temporary.persist(target).map_err(|error| error.error).map(drop)),
        };
        written.map_err(|source| Error::Write { path: self.path, source })
    }
}

fn place(path: &Path) -> io::Result<Place> {
    if path == Path::new("-") {
        return Ok(Place::Stdout);
    }
    // Through links: the file that a link names is replaced, not the link.
    let target = match fs::canonicalize(path) {
        Ok(target) => target,
        Err(error) if error.kind() == io::ErrorKind::NotFound => env::current_dir()?.join(path),
        Err(error) => return Err(error),
    };
    match fs::metadata(&target) {
        Ok(facts) if facts.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Ok(facts) if !facts.is_file() => {
            return Ok(Place::Stream(fs::OpenOptions::new().write(true).open(&target)?));
        }
        Ok(facts) if facts.permissions().readonly() => {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        _ => {}
    }
    let folder = target.parent().unwrap_or(Path::new("/"));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".rt-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As any new file, under the umask; a file that is replaced keeps what it had.
        let mode = fs::metadata(&target).map_or(0o666, |facts| facts.permissions().mode());
        builder.permissions(fs::Permissions::from_mode(mode));
    }
    Ok(Place::File { temporary: builder.tempfile_in(folder)?, target })
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
