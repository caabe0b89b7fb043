//! What all pictures share: colours, letters, rectangles.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use thiserror::Error;

/// The picture could not be drawn.
#[derive(Debug, Error)]
#[error("cannot draw the picture: {reason}")]
pub struct PictureError {
    /// What the drawing library says.
    pub reason: String,
}

pub(crate) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

pub(crate) const PAPER: RGBColor = RGBColor(255, 255, 255);
pub(crate) const FRAME: RGBColor = RGBColor(208, 215, 222);
pub(crate) const INK: RGBColor = RGBColor(31, 41, 51);
pub(crate) const SOFT: RGBColor = RGBColor(92, 105, 117);
// As on the pages: what is before, re-tuned only, and corrected.
pub(crate) const BEFORE: RGBColor = RGBColor(201, 72, 11);
pub(crate) const RETUNED: RGBColor = RGBColor(122, 91, 168);
pub(crate) const CORRECTED: RGBColor = RGBColor(11, 102, 176);

/// A rectangle from corner to corner.
pub(crate) fn rectangle(root: &Area<'_>, [a, b, c, d]: [i32; 4], style: ShapeStyle) -> Result<(), PictureError> {
    root.draw(&Rectangle::new([(a, b), (c, d)], style)).map_err(failed)
}

/// Plain letters whose top is at a point.
pub(crate) fn text(
    root: &Area<'_>,
    s: &str,
    at: [i32; 2],
    size: i32,
    ink: RGBColor,
    h: HPos,
) -> Result<(), PictureError> {
    write(root, s, at, size, FontStyle::Normal, ink, h)
}

/// Bold letters whose top left is at a point.
pub(crate) fn bold(root: &Area<'_>, s: &str, at: [i32; 2], size: i32) -> Result<(), PictureError> {
    write(root, s, at, size, FontStyle::Bold, INK, HPos::Left)
}

fn write(
    root: &Area<'_>,
    s: &str,
    [x, y]: [i32; 2],
    size: i32,
    style: FontStyle,
    ink: RGBColor,
    h: HPos,
) -> Result<(), PictureError> {
    // The SVG backend writes letters smaller by 1.24 than it is asked to.
    let font = FontDesc::new(FontFamily::SansSerif, 1.24 * f64::from(size), style);
    let style = TextStyle::from(font).color(&ink).pos(Pos::new(h, VPos::Top));
    root.draw(&Text::new(s.to_owned(), (x, y), style)).map_err(failed)
}

/// What the drawing library says.
pub(crate) fn failed(e: impl std::fmt::Display) -> PictureError {
    PictureError { reason: e.to_string() }
}

/// Tags open and close in order, and no bare ampersand or bracket is left in the text.
#[cfg(test)]
pub(crate) fn well_formed(svg: &str) {
    let mut open: Vec<&str> = Vec::new();
    for piece in svg.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').expect("every bracket closes");
        assert!(!text.contains('>'), "stray bracket in {text:?}");
        let entity = |t: &str| ["amp;", "lt;", "gt;", "quot;", "#"].iter().any(|e| t.starts_with(e));
        assert!(text.split('&').skip(1).all(entity), "bare ampersand in {text:?}");
        if tag.starts_with(['?', '!']) {
            continue;
        }
        let name = tag.trim_start_matches('/').split([' ', '/', '\n']).next().unwrap_or_default();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "still open: {open:?}");
}
