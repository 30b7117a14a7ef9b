//! What the tests share.

use std::io;
use std::path::{Path, PathBuf};

use rt_scene::{Error, Mesh, Scene, Triangle};

/// Reads an OBJ that names no material libraries, called `t.obj`.
pub(crate) fn obj(text: impl AsRef<[u8]>) -> Result<Scene, Error> {
    rt_scene::obj::parse(text.as_ref(), "t.obj", &mut |_| Err(io::ErrorKind::NotFound.into()))
}

/// Reads an NFF called `t.nff`.
pub(crate) fn nff(text: impl AsRef<[u8]>) -> Result<Scene, Error> {
    rt_scene::nff::parse(text.as_ref(), "t.nff")
}

/// The headline of every diagnostic of an invalid file.
pub(crate) fn headlines(result: Result<Scene, Error>) -> Vec<String> {
    match result {
        Err(Error::Invalid(diagnostics)) => diagnostics.iter().map(|d| d.headline()).collect(),
        other => panic!("expected an invalid file, found {other:?}"),
    }
}

/// The one error of a file that has one.
pub(crate) fn error(result: Result<Scene, Error>) -> String {
    let [headline] = headlines(result).try_into().expect("one error");
    headline
}

/// A sample scene, if the samples are there.
pub(crate) fn sample(name: &str) -> Option<PathBuf> {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes");
    let path = shared.join(name);
    if !path.exists() {
        skip(name);
        return None;
    }
    Some(path)
}

#[expect(clippy::print_stderr, reason = "a test says what it skips")]
fn skip(name: &str) {
    eprintln!("skipped: no {name}");
}

/// Twice the area of a triangle, in space.
pub(crate) fn double_area(mesh: &Mesh, triangle: &Triangle) -> f64 {
    let [a, b, c] = triangle.position.map(|i| mesh.positions[i as usize].to_array().map(f64::from));
    let u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt()
}
