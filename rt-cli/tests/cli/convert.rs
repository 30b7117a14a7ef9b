//! `rt convert` and `rt completions`.

use crate::support::{Picture, Scratch};

const LOOK: [&str; 10] = [
    "-s",
    "60x40",
    "--eye=1,2,6",
    "--target=0,1,0",
    "--up=0,1,0",
    "--fov=45",
    "--background=0.1,0.2,0.3",
    "--light=-1,2.5,1.5",
    "--depth",
    "3",
];

#[track_caller]
fn pixels(scratch: &Scratch, scene: &str, flags: &[&str]) -> Vec<u8> {
    Picture::decode(&scratch.png(&[&[scene], flags].concat())).pixels
}

#[test]
fn a_converted_scene_looks_the_same() {
    let scratch = Scratch::with_room();
    let run = scratch.rt(&["convert", "room.obj", "-o", "a.nff"]).exits(0);
    assert_eq!(run.stderr, "a.nff: 7 triangles, 3 materials\n");
    let run = scratch.rt(&["convert", "a.nff", "-o", "b.obj"]).exits(0);
    assert_eq!(run.stderr, "b.obj: 7 triangles, 3 materials\n");
    let run = scratch.rt(&["convert", "b.obj", "-o", "c.aff"]).exits(0);
    assert_eq!(run.stderr, "c.aff: 7 triangles, 3 materials\n");
    assert_eq!(scratch.names(), ["a.nff", "b.mtl", "b.obj", "c.aff", "room.mtl", "room.obj"]);
    let want = pixels(&scratch, "room.obj", &LOOK);
    for scene in ["a.nff", "b.obj", "c.aff"] {
        assert!(pixels(&scratch, scene, &LOOK) == want, "{scene}");
    }
    let geometry = [&LOOK[..], &["--integrator", "normals"]].concat();
    let own = pixels(&scratch, "room.obj", &geometry);
    assert!(own != want && pixels(&scratch, "b.obj", &geometry) == own);
}

#[test]
fn textures_go_with_their_scene() {
    let scratch = Scratch::new();
    std::fs::create_dir(scratch.path("far")).unwrap();
    let corners = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let face = "mtllib a.mtl\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
    scratch.file("far/a.obj", format!("{corners}{face}"));
    scratch.file("far/a.mtl", "newmtl m\nmap_Kd -s 2 2 chess.png\n");
    // Any picture will do.
    scratch.rt(&["render", "spd:balls:1", "-s", "8x8", "-q", "-o", "far/chess.png"]).exits(0);
    let run = scratch.rt(&["convert", "far/a.obj", "-o", "b.obj"]).exits(0);
    assert_eq!(run.stderr, "b.obj: 2 triangles, 1 material\n");
    assert_eq!(scratch.names(), ["b.0.png", "b.mtl", "b.obj", "far"]);
    let look = ["-s", "40x40"];
    let drawn = pixels(&scratch, "far/a.obj", &look);
    assert!(pixels(&scratch, "b.obj", &look) == drawn);
    assert!(pixels(&scratch, "b.obj", &[&look[..], &["--no-textures"]].concat()) != drawn);
}

#[test]
fn nff_and_aff_hold_all_of_an_nff() {
    let scratch = Scratch::new();
    for scene in ["spd:balls:1", "spd:mount:2", "spd:rings:1", "spd:tree:2", "spd:teapot:2"] {
        let want = pixels(&scratch, scene, &["-s", "40x40"]);
        for file in ["a.nff", "a.aff"] {
            let run = scratch.rt(&["convert", scene, "-o", file]).exits(0);
            assert!(!run.stderr.contains("warning"), "{}", run.stderr);
            assert!(pixels(&scratch, file, &["-s", "40x40"]) == want, "{scene} as {file}");
            let again = format!("b.{}", &file[2..]);
            let run = scratch.rt(&["convert", file, "-q", "-o", &again]).exits(0);
            assert!(scratch.bytes(&again) == scratch.bytes(file), "{scene}: {file}, once more");
            assert!(run.stderr.is_empty(), "{}", run.stderr);
        }
        let piped = scratch.rt(&["convert", "a.nff", "-q", "-o", "-"]).exits(0);
        assert!(piped.stdout == scratch.bytes("a.nff"), "{scene}: the same on standard output");
    }
}

#[test]
fn an_aff_and_what_it_includes_become_one_nff() {
    let scratch = Scratch::new();
    std::fs::create_dir(scratch.path("folder")).unwrap();
    let view = "v from 0 0 9 at 0 0 0 up 0 1 0 angle 40 hither 1 resolution 60 40";
    let text = format!("b 0 0 0.5 {view} l 5 9 9\nxs 1 2 1 0 0 1 30 1 0 0 {{ i 0 ball.aff }}\n");
    scratch.file("folder/a.aff", text);
    scratch.file("folder/ball.aff", "f 1 0.5 0.25 0.8 0.25 10 0 1\ns 0 0 0 1 % a ball");
    let run = scratch.rt(&["convert", "folder/a.aff", "-o", "a.nff"]).exits(0);
    assert!(run.stderr.starts_with("warning: 1 stretched primitive: drawn"), "{}", run.stderr);
    let of_aff = pixels(&scratch, "folder/a.aff", &[]);
    assert!(pixels(&scratch, "a.nff", &[]) == of_aff);
    let red = of_aff.chunks(3).filter(|pixel| pixel[0] > 100).count();
    assert!(red > 100 && of_aff[..3] == [0, 0, 188], "a ball before a blue sky");
}

#[test]
fn a_ply_is_read() {
    let scratch = Scratch::new();
    let corners = ["0 0 0", "2 0 0", "2 2 0.5", "0 2 1"];
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
                  end_header\n";
    scratch.file("a.ply", format!("{header}{}\n4 0 1 2 3\n", corners.join("\n")));
    let vertices = corners.map(|corner| format!("v {corner}\n")).concat();
    scratch.file("a.obj", format!("{vertices}f 1 2 3 4\n"));
    let run = scratch.rt(&["convert", "a.ply", "-o", "b.obj"]).exits(0);
    assert_eq!(run.stderr, "b.obj: 2 triangles, 1 material\n");
    let want = pixels(&scratch, "a.obj", &["-s", "40x40"]);
    for scene in ["a.ply", "b.obj"] {
        assert!(pixels(&scratch, scene, &["-s", "40x40"]) == want, "{scene}");
    }
    scratch.file("bad.ply", format!("{header}{}\n4 0 1 2\n", corners.join("\n")));
    let run = scratch.rt(&["info", "bad.ply"]).exits(1);
    let message = "bad.ply:14:1: Expected 4 list elements, but found only 3.\n  4 0 1 2\n  ^\n";
    assert!(run.stderr.ends_with(message), "{}", run.stderr);
}

#[test]
fn what_a_format_cannot_hold_is_told() {
    let scratch = Scratch::with_room();
    let run = scratch.rt(&["convert", "spd:balls:1", "-o", "a.obj"]).exits(1);
    let message = "error: an OBJ file cannot hold spd:balls:1's 10 spheres: write an NFF, or make \
                   triangles of them with --tessellate\n";
    assert_eq!(run.stderr, message);
    assert_eq!(scratch.names(), ["room.mtl", "room.obj"]);
    let run = scratch.rt(&["convert", "spd:balls:1", "--tessellate", "-o", "a.obj"]).exits(0);
    let lost = "warning: an OBJ has no place for 3 lights and the view (--eye 2.1,1.3,1.7 ";
    assert!(run.stderr.starts_with(lost), "{}", run.stderr);
    assert!(run.stderr.contains(" and the background\na.obj: 1922 triangles"), "{}", run.stderr);
    scratch.file("lamp.obj", "mtllib lamp.mtl\nusemtl lamp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch.file("lamp.mtl", "newmtl lamp\nKd 0 0 0\nKe 1 1 1\n");
    let run = scratch.rt(&["convert", "lamp.obj", "-o", "lamp.nff"]).exits(0);
    let poorer = "warning: an NFF says less of materials: 1 material will look different\n";
    assert!(run.stderr.starts_with(poorer), "{}", run.stderr);
    // Highlights of a colour are more than an NFF can say, but not more than an AFF can.
    scratch.file("lamp.mtl", "newmtl lamp\nKd 0 0 0\nKs 1 0.5 0\nillum 3\n");
    let run = scratch.rt(&["convert", "lamp.obj", "-o", "lamp.nff"]).exits(0);
    assert!(run.stderr.starts_with(poorer), "{}", run.stderr);
    let run = scratch.rt(&["convert", "lamp.obj", "-o", "lamp.aff"]).exits(0);
    assert_eq!(run.stderr, "lamp.aff: 1 triangle, 1 material\n");
    let quiet = scratch.rt(&["convert", "lamp.obj", "-o", "lamp.nff", "-q"]).exits(0);
    assert!(quiet.stderr.is_empty());
}

#[test]
fn nothing_is_written_of_what_fails() {
    let scratch = Scratch::with_room();
    scratch.file("bad.nff", "s 0 0 0\n");
    scratch.file("old.obj", "precious");
    let before = scratch.names();
    for (args, code, message) in [
        (
            &["bad.nff", "-o", "old.obj"][..],
            1,
            "bad.nff:1:8: expected 4 numbers after 's', found 3",
        ),
        (
            &["room.obj", "-o", "a.ply"],
            1,
            "error: cannot write a.ply: give it the extension .nff, .obj or .aff",
        ),
        (&["room.obj", "-o", "no/a.obj"], 1, "error: cannot write no/a.obj: there is no folder no"),
        (&["no.obj", "-o", "a.obj"], 1, "error: cannot read no.obj: No such file"),
        (&["room.obj"], 2, "error: the following required arguments"),
    ] {
        let run = scratch.rt(&[&["convert"], args].concat()).exits(code);
        assert!(run.stderr.starts_with(message), "{}", run.stderr);
        assert_eq!(scratch.names(), before);
    }
    assert_eq!(scratch.bytes("old.obj"), b"precious");
}

#[test]
fn strict_takes_a_missing_file_for_an_error() {
    let scratch = Scratch::with_room();
    std::fs::remove_file(scratch.path("room.mtl")).unwrap();
    let missing =
        "room.obj:1:8: cannot read material library 'room.mtl': No such file or directory";
    for args in [
        &["render", "room.obj", "-o", "a.png", "-s", "8x8"][..],
        &["convert", "room.obj", "-o", "a.nff"],
        &["info", "room.obj"],
        &["bench", "room.obj", "-s", "8x8", "--rounds", "1"],
    ] {
        scratch.rt(args).exits(0);
        let _ = std::fs::remove_file(scratch.path("a.png"));
        let _ = std::fs::remove_file(scratch.path("a.nff"));
        let run = scratch.rt(&[args, &["--strict"]].concat()).exits(1);
        assert_eq!(run.stderr, format!("error: files of the scene are missing:\n  {missing}\n"));
        assert_eq!(scratch.names(), ["room.obj"]);
    }
    let odd = scratch.rt(&["render", "spd:balls:0", "--strict", "-o", "a.png", "-s", "8x8"]);
    odd.exits(0);
}

#[test]
fn every_shell_gets_its_completions() {
    let scratch = Scratch::new();
    for (shell, word) in [
        ("bash", "complete -F"),
        ("zsh", "#compdef rt"),
        ("fish", "complete -c rt"),
        ("powershell", "Register-ArgumentCompleter"),
        ("elvish", "edit:completion"),
    ] {
        let text = scratch.rt(&["completions", shell]).exits(0).text();
        for word in [word, "render", "tessellate", "max-mse"] {
            assert!(text.contains(word), "{shell}: {word}");
        }
    }
    scratch.rt(&["completions", "cmd"]).exits(2);
    scratch.rt(&["completions"]).exits(2);
    // A shell takes it, and offers the commands.
    let script = "eval \"$(\"$@\" completions bash)\"; COMP_WORDS=(rt co); COMP_CWORD=1; _rt rt co; \
                  echo \"${COMPREPLY[@]}\"";
    let shell = ["bash", "--norc", "-c", script, "bash"].map(Into::into);
    let argv = [&shell[..], &crate::support::argv()].concat();
    let offered = crate::support::run(&mut scratch.command(&argv)).exits(0).text();
    assert_eq!(offered.trim(), "compare convert completions");
}
