//! What can go wrong when a figure is written.

/// A figure could not be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FigureError {
    /// The picture would have more pixels than fit in memory, or none at all.
    #[error("a picture of {width:.0} x {height:.0} pixels cannot be made; choose another scale")]
    PictureSize {
        /// Width asked for, in pixels.
        width: f64,
        /// Height asked for, in pixels.
        height: f64,
    },
    /// The pixels could not be compressed.
    #[error("the picture could not be encoded as PNG: {reason}")]
    Encoding {
        /// What the encoder said.
        reason: String,
    },
}
