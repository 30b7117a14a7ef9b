//! Readers and writers of scenes, from outside.

mod aff;
mod mtl;
mod mutations;
mod nff;
mod obj;
mod obj_errors;
mod opening;
mod ply;
mod polygons;
mod samples;
mod spd;
mod support;
mod tessellate;
mod textures;
