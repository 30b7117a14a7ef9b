//! What can go wrong.

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

/// A command failed. Its text is complete: it needs no source beside it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] rt_scene::Error),
    /// The picture cannot be made.
    #[error(transparent)]
    Render(#[from] rt_render::RenderError),
    /// The level is not to be had.
    #[error("{asked}: {source}")]
    Level {
        /// Where it was asked for.
        asked: String,
        /// Why not, and what there is.
        source: rt_render::LevelError,
    },
    /// A file of measured rows cannot be read.
    #[error("cannot read {}: {}", path.display(), reason(source))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A file is not one of measured rows.
    #[error("{}:{}:{}: {}", path.display(), source.line(), source.column(), complaint(source))]
    Rows {
        /// The file.
        path: PathBuf,
        /// Where, and what is wrong there.
        source: serde_json::Error,
    },
    /// Measured rows do not make a chart.
    #[error("no chart: {0}")]
    Chart(String),
    /// A file cannot be written.
    #[error("cannot write {}: {}", path.display(), reason(source))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A picture cannot be encoded.
    #[error(transparent)]
    Encode(#[from] rt_picture::Error),
    /// A file is no picture that can be read.
    #[error("{}: {source}", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: rt_picture::Error,
    },
    /// Pictures of different sizes are not compared.
    #[error(
        "the sizes differ: {} has {}x{} pixels, {} has {}x{}",
        a.0.display(), a.1, a.2, b.0.display(), b.1, b.2
    )]
    Sizes {
        /// A picture, its width and its height.
        a: (PathBuf, u32, u32),
        /// The other's.
        b: (PathBuf, u32, u32),
    },
    /// Pictures differ by more than they may.
    #[error("too different: {}", .0.join("; "))]
    Different(Vec<String>),
    /// Flags that do not go together, where clap cannot know.
    #[error("{0}\n\nFor more information, try '--help'.")]
    Usage(String),
    /// Files that a scene names cannot be read, and that is taken for an error.
    #[error("files of the scene are missing:\n  {}", .0.join("\n  "))]
    Missing(Vec<String>),
    /// A part of an interrupted picture is there.
    #[error(
        "{} is there, of a picture that was interrupted: --resume goes on with it, \
         --overwrite begins anew", .0.display()
    )]
    PartThere(PathBuf),
    /// A part that is there is not one of this picture.
    #[error("{} is {why}: --overwrite begins anew", path.display())]
    OtherPart {
        /// The file.
        path: PathBuf,
        /// What it is.
        why: String,
    },
    /// There is no place to keep a part.
    #[error("--resume takes a file to write to: {} is none", .0.display())]
    NoPart(PathBuf),
    /// Ctrl-C cannot be listened to.
    #[error("cannot listen to interrupts: {}", reason(.0))]
    Signal(io::Error),
    /// The user did not want to wait.
    #[error("{0}")]
    Interrupted(String),
    /// The extension of an output file is of no format that is written.
    #[error("cannot write {}: give it the extension .{}", path.display(), extensions(known))]
    OutputFormat {
        /// The file.
        path: PathBuf,
        /// The extensions.
        known: &'static [&'static str],
    },
    /// Two outputs would go to one place.
    #[error("{}: picture and statistics cannot go to the same place", .0.display())]
    SameOutput(PathBuf),
    /// The simulator does not do what is asked of it.
    #[error("cachegrind: {0}")]
    Cachegrind(String),
    /// A kernel is less accurate than it is known to be.
    #[error("less accurate than it should be:\n  {}", .0.join("\n  "))]
    Inaccurate(Vec<String>),
    /// A way to trace gave other hits than another. This is a fault of the program.
    #[error("{scene}: {differing} hits differ between {way} and the first row: please report this")]
    Differ {
        /// The scene.
        scene: String,
        /// How many.
        differing: u64,
        /// Where.
        way: String,
    },
}

impl Error {
    /// What the program says to scripts.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Error::Inaccurate(_) | Error::Different(_) => ExitCode::from(3),
            Error::Usage(_) => ExitCode::from(2),
            Error::Interrupted(_) => ExitCode::from(130),
            _ => ExitCode::FAILURE,
        }
    }

    /// Whether its text begins with the place that it is about.
    pub(crate) fn has_place(&self) -> bool {
        matches!(self, Error::Scene(rt_scene::Error::Invalid(_)) | Error::Rows { .. })
    }
}

/// `.a, .b or .c`.
fn extensions(known: &[&str]) -> String {
    match known {
        [first @ .., last] if !first.is_empty() => format!("{} or .{last}", first.join(", .")),
        _ => known.concat(),
    }
}

/// What is wrong with JSON, without the place.
fn complaint(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.rsplit_once(" at line ").map_or(text.clone(), |(words, _)| words.to_owned())
}

/// The system's words without its error number.
pub(crate) fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    text.split_once(" (os error ").map_or(text.clone(), |(words, _)| words.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missed_threshold_has_a_code_of_its_own() {
        let missed = Error::Inaccurate(vec!["a".to_owned(), "b".to_owned()]);
        assert_eq!(missed.to_string(), "less accurate than it should be:\n  a\n  b");
        assert_eq!(missed.exit_code(), ExitCode::from(3));
        assert_eq!(Error::Different(vec![]).exit_code(), ExitCode::from(3));
        assert_eq!(Error::Usage(String::new()).exit_code(), ExitCode::from(2));
        assert_eq!(Error::Interrupted(String::new()).exit_code(), ExitCode::from(130));
        assert_eq!(Error::SameOutput("x".into()).exit_code(), ExitCode::FAILURE);
    }

    #[test]
    fn extensions_are_listed_as_people_do() {
        assert_eq!(extensions(&["a"]), "a");
        assert_eq!(extensions(&["a", "b"]), "a or .b");
        assert_eq!(extensions(&["a", "b", "c"]), "a, .b or .c");
    }
}
