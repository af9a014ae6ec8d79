//! Colours put over one another, channel by channel, in the values that are stored.

mod alpha;
mod composite;

pub use alpha::Alpha;
pub use composite::Composite;
