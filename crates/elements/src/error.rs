//! What is wrong with an element.

/// Why an element cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ElementError {
    /// A property must be positive (or, where it says so, not negative) and finite.
    #[error("its {property} is {value}")]
    Property {
        /// Name of the property.
        property: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// Both ends in one place.
    #[error("it has no length: both ends lie in one place")]
    NoLength,
    /// The orientation vector does not tell where axes 2 and 3 point.
    #[error("its orientation vector is zero or runs along the element")]
    ParallelOrientation,
    /// Nothing holds the element's rotation about its own axis.
    #[error("it is free to twist at both ends, and turns about its own axis")]
    Twists,
    /// A shell without area.
    #[error("it has no area")]
    NoArea,
    /// A quadrilateral that crosses itself, is concave, or has three corners on one line.
    #[error(
        "corner {corner} (from 1) is {angle:.1} degrees: the corners are not in order around the element, or it is no \
         convex quadrilateral"
    )]
    Corner {
        /// Number of the corner, from 1.
        corner: usize,
        /// Inner angle, degrees, between −180 and 180.
        angle: f64,
    },
    /// A triangle with a corner that is hardly one.
    #[error("it is a sliver: its height is {ratio:.1e} of its longest side")]
    Sliver {
        /// Height over longest side.
        ratio: f64,
    },
    /// The corners of a quadrilateral are too far from a plane.
    #[error("its corners lie {percent:.0} % of its size off their mean plane; use triangles")]
    Warped {
        /// Distance of each corner from the mean plane over the square root of the area, %.
        percent: f64,
    },
}

/// `value` is above `least`; NaN is not.
pub(crate) fn exceeds(value: f64, least: f64) -> bool {
    value > least
}

/// `value` is positive and finite.
pub(crate) fn positive(property: &'static str, value: f64) -> Result<(), ElementError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(ElementError::Property { property, value }) }
}

/// `value` is not negative and finite.
pub(crate) fn not_negative(property: &'static str, value: f64) -> Result<(), ElementError> {
    if value >= 0.0 && value.is_finite() { Ok(()) } else { Err(ElementError::Property { property, value }) }
}
