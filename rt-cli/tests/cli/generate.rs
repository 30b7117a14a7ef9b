//! `rt gen`.

use crate::support::{Picture, Scratch};

#[test]
fn a_generated_file_gives_the_picture_of_the_procedure() {
    let scratch = Scratch::new();
    let run = scratch.rt(&["gen", "balls", "--size", "2", "-o", "balls.nff"]).exits(0);
    assert_eq!(run.stderr, "balls.nff: 1 polygon, 91 spheres\n");
    assert!(run.stdout.is_empty());
    let picture = |scene| Picture::decode(&scratch.png(&[scene, "-s", "60x40"]));
    let (mut file, mut procedure) = (picture("balls.nff"), picture("spd:balls:2"));
    assert_eq!(file.text.remove("Scene").unwrap(), "balls.nff");
    assert_eq!(procedure.text.remove("Scene").unwrap(), "spd:balls:2");
    assert!(file == procedure);
    assert!(file.pixels.iter().any(|&byte| byte != file.pixels[0]), "it is not empty");
}

#[test]
fn the_extension_tells_the_format_and_without_one_it_is_nff() {
    let scratch = Scratch::new();
    let stdout = scratch.rt(&["gen", "balls", "--size", "0"]).exits(0);
    assert!(stdout.stderr.is_empty(), "{}", stdout.stderr);
    let text = stdout.stdout;
    assert!(text.starts_with(b"b 0.078 0.361 0.753\n"));
    assert_eq!(scratch.rt(&["gen", "balls", "--size", "0", "-o", "-"]).exits(0).stdout, text);
    for name in ["a.nff", "a.NFF", "a"] {
        scratch.rt(&["gen", "balls", "--size", "0", "-o", name]).exits(0);
        assert_eq!(scratch.bytes(name), text, "{name}");
    }
    let run = scratch.rt(&["gen", "balls", "-o", "a.txt"]).exits(1);
    assert_eq!(run.stderr, "error: cannot write a.txt: give it the extension .nff, .obj or .aff\n");
}

/// The same triangles in the same order, with the same normals; materials differ in what OBJ holds.
#[test]
fn a_tessellation_is_the_same_in_a_file() {
    let scratch = Scratch::new();
    let run = scratch.rt(&["gen", "rings", "--size", "1", "--tessellate", "-o", "rings.obj"]);
    assert_eq!(run.exits(0).stderr, "rings.obj: 30 cylinders, 1 polygon, 30 spheres\n");
    assert_eq!(scratch.names(), ["rings.mtl", "rings.obj"]);
    let look = ["-s", "60x40", "--integrator", "normals", "--background", "0,0,0"];
    let view = ["--eye=-1,-2.6,0.5", "--target=-1,-1.6,0.5", "--up=0,0,1", "--fov=45"];
    let flags = [&look[..], &view].concat();
    let pixels = |scene: &[&str]| Picture::decode(&scratch.png(&[scene, &flags].concat())).pixels;
    assert!(pixels(&["rings.obj"]) == pixels(&["spd:rings:1", "--tessellate"]));
}

#[test]
fn the_size_without_a_flag_is_the_scene_s_own() {
    let scratch = Scratch::new();
    let own = scratch.rt(&["gen", "balls"]).exits(0).stdout;
    assert_eq!(own, scratch.rt(&["gen", "balls", "--size", "4"]).exits(0).stdout);
    assert_ne!(own, scratch.rt(&["gen", "balls", "--size", "3"]).exits(0).stdout);
}

#[test]
fn what_cannot_be_generated_leaves_nothing() {
    let scratch = Scratch::new();
    scratch.file("old.obj", "precious");
    for (args, message) in [
        (&["balls", "-o", "new.obj"][..], "an OBJ file cannot hold spd:balls:4's 7381 spheres"),
        (&["balls", "-o", "old.obj"], "an OBJ file cannot hold"),
        (&["bells", "-o", "a.nff"], "unknown scene 'spd:bells': there is spd:balls"),
        (&["balls", "--size", "99", "-o", "a.nff"], "spd:balls has no size '99': sizes go from 0"),
        (&["balls", "-o", "no/a.nff"], "cannot write no/a.nff: there is no folder no"),
    ] {
        let run = scratch.rt(&[&["gen"], args].concat()).exits(1);
        assert!(run.stderr.starts_with(&format!("error: {message}")), "{}", run.stderr);
        assert!(run.stdout.is_empty());
    }
    assert_eq!(scratch.names(), ["old.obj"]);
    assert_eq!(scratch.bytes("old.obj"), b"precious");
    for name in ["spd:bells", "spd:balls:99", "spd:balls:x", "spd:"] {
        scratch.rt(&["render", name, "-o", "a.png"]).exits(1);
    }
    assert_eq!(scratch.names(), ["old.obj"]);
}
