//! What rays meet, and how they meet it: plain data.

mod aabb;
mod cone;
mod hit;
mod quadric;
mod ray;
mod sphere;
mod triangle;

pub use aabb::Aabb;
pub(crate) use aabb::PADDING;
pub use cone::Cone;
pub use hit::Hit;
pub use quadric::{Curved, Quadric};
pub use ray::Ray;
pub use sphere::Sphere;
pub use triangle::Triangle;
