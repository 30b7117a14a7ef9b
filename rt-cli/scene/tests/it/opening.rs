//! Scenes by name.

use std::fs;
use std::path::PathBuf;

use rt_scene::open;

/// A folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&path).unwrap();
    path
}

fn message(name: &str) -> String {
    open(name).unwrap_err().to_string()
}

#[test]
fn names_that_lead_nowhere() {
    let missing = "cannot read no/bunny.obj: No such file or directory";
    assert_eq!(message("no/bunny.obj"), missing);
    assert_eq!(message("no/balls.NFF"), missing.replace("bunny.obj", "balls.NFF"));
    let format =
        "cannot tell the format of bunny.stl: files that are read end in .obj, .nff, .aff or .ply";
    assert_eq!(message("bunny.stl"), format);
    assert_eq!(message("obj"), format.replace("bunny.stl", "obj"));
    for name in ["spd:foo", "spd:foo:3"] {
        let message = message(name);
        assert!(message.starts_with("unknown scene 'spd:foo': there is spd:balls, "), "{message}");
    }
    assert_eq!(message("spd:balls:8"), "spd:balls has no size '8': sizes go from 0 to 7");
    assert_eq!(message("spd:balls:x"), "spd:balls has no size 'x': sizes go from 0 to 7");
    assert_eq!(message("spd:balls:"), "spd:balls has no size '': sizes go from 0 to 7");
}

#[test]
fn folders_and_empty_files() {
    let folder = folder("folders_and_empty_files");
    let inner = folder.join("folder.obj");
    fs::create_dir_all(&inner).unwrap();
    let name = inner.to_str().unwrap();
    assert_eq!(message(name), format!("cannot read {name}: it is a directory"));
    let empty = folder.join("empty.obj");
    fs::write(&empty, "").unwrap();
    let name = empty.to_str().unwrap();
    assert_eq!(message(name), format!("{name}: no faces: nothing to draw without 'f' statements"));
}

#[cfg(unix)]
#[test]
fn what_never_ends_is_not_read() {
    let folder = folder("what_never_ends_is_not_read");
    let endless = folder.join("endless.obj");
    let _ = fs::remove_file(&endless);
    std::os::unix::fs::symlink("/dev/zero", &endless).unwrap();
    let name = endless.to_str().unwrap();
    assert_eq!(message(name), format!("cannot read {name}: it is not a regular file"));
}

#[test]
fn libraries_are_looked_for_beside_the_file() {
    let folder = folder("libraries");
    fs::create_dir_all(folder.join("sub folder")).unwrap();
    fs::write(folder.join("sub folder/m.mtl"), "newmtl red\nKd 1 0 0\n").unwrap();
    let text = "mtllib sub folder\\m.mtl\nmtllib no.mtl\nusemtl red\n\
                v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let path = folder.join("Scene.OBJ");
    fs::write(&path, text).unwrap();
    let name = path.to_str().unwrap();
    let scene = open(name).unwrap();
    assert_eq!(scene.name, "Scene.OBJ");
    assert_eq!(scene.materials[0].diffuse.to_array(), [1.0, 0.0, 0.0]);
    let warning = "2:8: cannot read material library 'no.mtl': No such file or directory";
    assert_eq!(scene.facts.warnings, [format!("{name}:{warning}")]);
}

#[test]
fn a_procedural_scene() {
    assert_eq!(open("spd:balls:1").unwrap().spheres.len(), 10);
    assert_eq!(open("spd:balls").unwrap().name, "spd:balls:4");
}
