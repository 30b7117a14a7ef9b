//! What is finished of a picture, in a file beside it.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use glam::Vec3;
use rt_picture::part::{self, Part};

use crate::error::Error;

/// The place: the picture's file with `.part` after its name.
#[derive(Debug)]
pub(crate) struct PartFile(PathBuf);

impl PartFile {
    /// Beside a file that is, or will be, the picture.
    pub(crate) fn beside(picture: &Path) -> PartFile {
        let mut name = picture.as_os_str().to_owned();
        name.push(".part");
        PartFile(name.into())
    }

    /// Its name.
    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// Whether there is one.
    pub(crate) fn is_there(&self) -> bool {
        self.0.symlink_metadata().is_ok()
    }

    /// What is in it, if it is of the picture that `lines` describe; none if there is no file.
    pub(crate) fn read(&self, lines: &[String]) -> Result<Option<Part>, Error> {
        if !self.is_there() {
            return Ok(None);
        }
        let bytes = super::read_file(&self.0)?;
        let other = |why: String| Error::OtherPart { path: self.0.clone(), why };
        let part = part::read(&bytes).ok_or_else(|| other("no part of a picture".to_owned()))?;
        match part.lines == lines {
            true => Ok(Some(part)),
            false => Err(other(format!("of another picture: {}", apart(&part.lines, lines)))),
        }
    }

    /// Begins a file, whatever was there.
    pub(crate) fn begin(&self, lines: &[String]) -> Result<PartWriter, Error> {
        let begin = || {
            let mut file = File::create(&self.0)?;
            file.write_all(&part::header(lines))?;
            Ok(file)
        };
        self.writer(begin())
    }

    /// Goes on after the bytes that count.
    pub(crate) fn go_on(&self, part: &Part) -> Result<PartWriter, Error> {
        let open = || {
            let file = OpenOptions::new().append(true).open(&self.0)?;
            file.set_len(part.len as u64)?;
            Ok(file)
        };
        self.writer(open())
    }

    /// Removes the file if there is one: the picture is complete.
    pub(crate) fn remove(&self) -> Result<(), Error> {
        match std::fs::remove_file(&self.0) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(self.error(error)),
            _ => Ok(()),
        }
    }

    fn writer(&self, file: io::Result<File>) -> Result<PartWriter, Error> {
        let file = file.map_err(|error| self.error(error))?;
        Ok(PartWriter { state: Mutex::new(State { file, failed: None }), path: self.0.clone() })
    }

    fn error(&self, source: io::Error) -> Error {
        Error::Write { path: self.0.clone(), source }
    }
}

/// Adds tiles, from all threads.
pub(crate) struct PartWriter {
    state: Mutex<State>,
    path: PathBuf,
}

struct State {
    file: File,
    /// The first failure, after which nothing is written.
    failed: Option<io::Error>,
}

impl PartWriter {
    /// Adds one tile.
    pub(crate) fn add(&self, tile: u32, pixels: &[Vec3]) {
        let record = part::record(tile, pixels);
        let mut state = self.state.lock().expect("no thread panics while it writes");
        if state.failed.is_none() {
            state.failed = state.file.write_all(&record).err();
        }
    }

    /// Tells what went wrong, if anything did.
    pub(crate) fn finish(self) -> Result<(), Error> {
        let state = self.state.into_inner().expect("all threads are done");
        match state.failed {
            Some(source) => Err(Error::Write { path: self.path, source }),
            None => Ok(()),
        }
    }
}

/// In what two descriptions differ.
fn apart(there: &[String], here: &[String]) -> String {
    let differing: Vec<_> = there
        .iter()
        .filter(|line| !here.contains(line))
        .map(|line| format!("'{}'", shown(line)))
        .collect();
    let wanted: Vec<_> = here.iter().filter(|line| !there.contains(line)).cloned().collect();
    let list = |lines: Vec<String>| match lines.is_empty() {
        true => "nothing else".to_owned(),
        false => lines.join(", "),
    };
    format!("it has {}, and this one {}", list(differing), list(wanted))
}

/// Fit for a terminal, for a file may hold anything.
fn shown(line: &str) -> String {
    line.chars().take(200).map(|c| if c.is_control() { '.' } else { c }).collect()
}
