//! Starts the program, and looks at what it leaves.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::time::Duration;
use std::{env, fs, thread};

use serde_json::Value;
use tempfile::TempDir;

/// One triangle.
pub(crate) const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A small scene with quads, smooth triangles, a mirror and a coloured wall.
pub(crate) const ROOM: &str = "\
mtllib room.mtl
v -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nv -2 3 -2\nv 2 3 -2
v 0 1.5 0\nv 0.8 0.2 0.8\nv -0.8 0.2 0.8\nv 0 0.2 -0.9
vn 0 1 0\nvn 1 0 1\nvn -1 0 1\nvn 0 0 -1
f 1 2 3 4
usemtl wall\nf 1 5 6 2
usemtl mirror\nf 7//1 9//3 8//2\nf 7//1 8//2 10//4\nf 7//1 10//4 9//3
";

/// The materials of [`ROOM`].
pub(crate) const ROOM_MTL: &str = "\
newmtl wall\nKd 0.7 0.2 0.1
newmtl mirror\nKd 0.1 0.1 0.3\nKs 0.6 0.6 0.6\nNs 20\nillum 3
";

/// What `--builder` may be.
pub(crate) const BUILDERS: [&str; 4] = ["binned-sah", "sweep-sah", "insertion", "spatial"];

/// What `--layout` may be.
pub(crate) const LAYOUTS: [&str; 3] = ["skip", "bvh4", "bvh8"];

/// Longer than anything takes, even under an emulator: who is not done then, hangs.
const HANGS: Duration = Duration::from_secs(120);

/// The program with what it takes to start it.
pub(crate) fn argv() -> Vec<OsString> {
    let runner = env::var("RT_RUNNER").unwrap_or_default();
    let runner = runner.split_whitespace().map(OsString::from);
    runner.chain([env!("CARGO_BIN_EXE_rt").into()]).collect()
}

/// What a run left behind.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

impl Run {
    /// The same, after making sure of the exit code.
    #[track_caller]
    pub(crate) fn exits(self, code: i32) -> Run {
        let Run { code: found, stdout, stderr } = &self;
        let stdout = String::from_utf8_lossy(&stdout[..stdout.len().min(2000)]);
        assert_eq!(*found, code, "\nstderr:\n{stderr}\nstdout:\n{stdout}");
        self
    }

    #[track_caller]
    pub(crate) fn json(&self) -> Value {
        serde_json::from_slice(&self.stdout).expect("standard output is JSON and nothing else")
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.stdout).into_owned()
    }
}

/// Waits for a command, but not for ever.
#[track_caller]
pub(crate) fn run(command: &mut Command) -> Run {
    let child = command.spawn().expect("the program starts");
    let pid = child.id().to_string();
    let (done, wait) = mpsc::channel();
    thread::spawn(move || done.send(child.wait_with_output()));
    let Ok(output) = wait.recv_timeout(HANGS) else {
        let _ = Command::new("kill").args(["-KILL", &pid]).status();
        panic!("{command:?} hangs");
    };
    let output = output.expect("it can be waited for");
    let stderr = String::from_utf8(output.stderr).expect("messages are UTF-8");
    assert!(!stderr.contains("panicked"), "{command:?}\n{stderr}");
    let code = output.status.code().unwrap_or_else(|| panic!("{}\n{stderr}", output.status));
    Run { code, stdout: output.stdout, stderr }
}

/// A folder to run the program in.
pub(crate) struct Scratch(TempDir);

impl Scratch {
    pub(crate) fn new() -> Scratch {
        Scratch(tempfile::tempdir().expect("a folder for the test"))
    }

    /// With `room.obj` and its materials.
    pub(crate) fn with_room() -> Scratch {
        let scratch = Scratch::new();
        scratch.file("room.obj", ROOM);
        scratch.file("room.mtl", ROOM_MTL);
        scratch
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn file(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("the folder can be written to");
    }

    #[track_caller]
    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// What is in the folder, hidden files and all.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("the folder is there");
        let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
        let mut names: Vec<_> = entries.map(|e| name(e).to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// A program in this folder, without the variables that `rt` looks at.
    pub(crate) fn command(&self, argv: &[OsString]) -> Command {
        let mut command = Command::new(&argv[0]);
        command.args(&argv[1..]).current_dir(self.0.path());
        command.env_remove("SIMD4_LEVEL").env_remove("CI").env("COLUMNS", "80");
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// `rt` in this folder, not started yet.
    pub(crate) fn rt_command(&self, args: &[&str]) -> Command {
        let mut command = self.command(&argv());
        command.args(args);
        command
    }

    /// Runs `rt` in this folder.
    #[track_caller]
    pub(crate) fn rt(&self, args: &[&str]) -> Run {
        run(&mut self.rt_command(args))
    }

    /// Renders to standard output and returns the file.
    #[track_caller]
    pub(crate) fn png(&self, args: &[&str]) -> Vec<u8> {
        let args = [&["render", "-q", "-o", "-"], args].concat();
        self.rt(&args).exits(0).stdout
    }
}

/// A picture that was read back.
#[derive(Debug, PartialEq)]
pub(crate) struct Picture {
    pub(crate) size: (u32, u32),
    /// Red, green, blue, row by row.
    pub(crate) pixels: Vec<u8>,
    /// The text chunks.
    pub(crate) text: BTreeMap<String, String>,
}

impl Picture {
    #[track_caller]
    pub(crate) fn decode(bytes: &[u8]) -> Picture {
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().expect("it is a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("it fits into memory")];
        let frame = reader.next_frame(&mut pixels).expect("its pixels are there");
        reader.finish().expect("nothing is missing at its end");
        assert_eq!(
            (frame.color_type, frame.bit_depth),
            (png::ColorType::Rgb, png::BitDepth::Eight)
        );
        let text = reader.info().utf8_text.iter();
        let text = text.map(|chunk| (chunk.keyword.clone(), chunk.get_text().expect("UTF-8")));
        Picture { size: (frame.width, frame.height), text: text.collect(), pixels }
    }

    #[track_caller]
    pub(crate) fn open(path: &Path) -> Picture {
        Picture::decode(&fs::read(path).expect("the picture is there"))
    }

    pub(crate) fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        let at = 3 * (y * self.size.0 + x) as usize;
        [self.pixels[at], self.pixels[at + 1], self.pixels[at + 2]]
    }
}

/// The names of a JSON object, in its order.
#[track_caller]
pub(crate) fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

/// The levels of this machine, as `rt info` lists them.
pub(crate) fn levels() -> Vec<String> {
    let machine = Scratch::new().rt(&["info", "--json"]).exits(0).json();
    let levels = machine["levels"].as_array().expect("a list of levels");
    levels.iter().map(|level| level.as_str().expect("a name").to_owned()).collect()
}

/// Says that a test did nothing, and why.
#[allow(clippy::print_stdout, reason = "cargo test shows it with --nocapture")]
pub(crate) fn skipped(why: &str) {
    println!("skipped: {why}");
}
