//! The arguments of `rt convert` and `rt completions`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args as Group;
use clap_complete::Shell;

use super::{OpenArgs, SCENE};

/// Write a scene in another format.
///
/// The extension of the file tells which: .nff, .aff, or .obj for scenes of polygons alone, which
/// --tessellate makes of any; beside the OBJ go its materials, as .mtl. What the format cannot hold
/// is told.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt convert bunny.obj -o bunny.nff\n  \
    rt convert balls.nff --tessellate 8 -o balls.obj\n  \
    rt convert kitchen.aff -o kitchen.nff")]
pub(crate) struct ConvertArgs {
    #[arg(help = SCENE)]
    pub(crate) scene: OsString,
    #[command(flatten)]
    pub(crate) opening: OpenArgs,
    /// The .nff, .obj or .aff file to write; - for NFF on standard output.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Say nothing but errors.
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// Write what makes a shell complete the commands and flags of rt.
#[derive(Group)]
#[command(after_help = "Examples:\n  \
    rt completions bash > ~/.local/share/bash-completion/completions/rt\n  \
    rt completions zsh > ~/.zfunc/_rt\n  \
    rt completions fish > ~/.config/fish/completions/rt.fish")]
pub(crate) struct CompletionsArgs {
    /// The shell.
    pub(crate) shell: Shell,
}
