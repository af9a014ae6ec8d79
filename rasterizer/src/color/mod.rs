//! Colours put over one another and interpolated, channel by channel, in the values that are stored.

mod alpha;
mod channels;
mod composite;

pub use alpha::Alpha;
pub use channels::Channels;
pub(crate) use channels::to_q16;
pub use composite::Composite;
