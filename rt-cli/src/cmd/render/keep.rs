//! What is finished of a picture is kept: when the user does not want to wait, or all the while.

use std::collections::BTreeMap;

use glam::Vec3;
use rt_picture::part::Part;
use rt_render::{Job, Made, Tiles, World, render_rest};

use crate::args::PictureOutputArgs;
use crate::error::Error;
use crate::output::{Output, PartFile, PartWriter};
use crate::report::identity;
use crate::ui::{self, Interrupt, Progress};

/// Where it is kept, and what is wanted of what is there.
pub(super) struct Keep {
    /// None where the picture is no file.
    place: Option<PartFile>,
    resume: bool,
    overwrite: bool,
}

impl Keep {
    /// Refuses, before any work, to lose what is there unless that is wanted.
    pub(super) fn new(args: &PictureOutputArgs, output: &Output) -> Result<Keep, Error> {
        let place = output.file().map(PartFile::beside);
        let (resume, overwrite) = (args.resume, args.overwrite);
        match &place {
            None if resume => return Err(Error::NoPart(args.path.clone())),
            Some(place) if place.is_there() && !resume && !overwrite => {
                return Err(Error::PartThere(place.path().into()));
            }
            _ => {}
        }
        Ok(Keep { place, resume, overwrite })
    }

    /// Renders what is not there yet.
    pub(super) fn render(
        &self,
        world: &World,
        job: &Job,
        progress: Progress,
        interrupt: &Interrupt,
        quiet: bool,
    ) -> Result<Made, Error> {
        let mut there = BTreeMap::new();
        let mut writer = None;
        if let Some(place) = self.place.as_ref().filter(|_| self.resume) {
            let lines = identity(world, job);
            writer = Some(match self.there(place, &lines)? {
                Some(part) => {
                    let writer = place.go_on(&part)?;
                    there = part.tiles;
                    writer
                }
                None => place.begin(&lines)?,
            });
        }
        if !there.is_empty() && !quiet {
            let (found, all) = (there.len(), Tiles::of(job).len());
            ui::say(&format!("resumed: {found} of {all} tiles are there"));
        }
        interrupt.hold();
        let watch = Watch { progress, writer, interrupt };
        let made = render_rest(world, job, &there, &watch);
        watch.progress.finish();
        let made = made?;
        watch.writer.map_or(Ok(()), PartWriter::finish)?;
        match made.finished.iter().all(|&finished| finished) {
            true => Ok(made),
            false => Err(self.interrupted(world, job, &made)?),
        }
    }

    /// The picture is written: nothing has to be kept.
    pub(super) fn complete(&self) -> Result<(), Error> {
        self.place.as_ref().map_or(Ok(()), PartFile::remove)
    }

    /// What is there of the same picture.
    fn there(&self, place: &PartFile, lines: &[String]) -> Result<Option<Part>, Error> {
        match place.read(lines) {
            Err(Error::OtherPart { .. }) if self.overwrite => Ok(None),
            read => read,
        }
    }

    /// Keeps what is finished, unless it is kept already; what there is to say.
    fn interrupted(&self, world: &World, job: &Job, made: &Made) -> Result<Error, Error> {
        let finished = made.finished.iter().filter(|&&finished| finished).count();
        let percent = finished * 100 / made.finished.len();
        let Some(place) = &self.place else {
            return Ok(Error::Interrupted(format!("interrupted at {percent} %")));
        };
        if !self.resume {
            let writer = place.begin(&identity(world, job))?;
            let (tiles, area) = (Tiles::of(job), job.area());
            for (tile, _) in made.finished.iter().enumerate().filter(|&(_, &finished)| finished) {
                let pixel = |(x, y)| made.film.pixel(x - area.left, y - area.top);
                let pixels: Vec<Vec3> = tiles.pixels(tile as u32).into_iter().map(pixel).collect();
                writer.add(tile as u32, &pixels);
            }
            writer.finish()?;
        }
        let place = place.path().display();
        Ok(Error::Interrupted(format!(
            "interrupted: {percent} % is kept in {place}, and --resume goes on with it"
        )))
    }
}

/// Stands between the renderer and those who want to know.
struct Watch<'a> {
    progress: Progress,
    writer: Option<PartWriter>,
    interrupt: &'a Interrupt,
}

impl rt_render::Progress for Watch<'_> {
    fn tiles(&self, done: usize, total: usize) {
        self.progress.show(done, total);
    }

    fn finished(&self, tile: u32, pixels: &[Vec3]) {
        if let Some(writer) = &self.writer {
            writer.add(tile, pixels);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.interrupt.is_noted()
    }
}
