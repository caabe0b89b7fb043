//! Elements of a response in words.

use verdict::Element;

/// An element for people.
pub(crate) const fn element(e: Element) -> &'static str {
    match e {
        Element::DeadTime => "dead time",
        Element::Gain => "gains of forward speed and turning",
        Element::TurnLimit => "a limit of turning",
        Element::ForwardLimit => "a limit of forward speed",
        Element::WheelLimit => "a limit of the wheels",
        Element::Ramp => "limits of acceleration",
        Element::Lag => "lag",
        Element::SideGain => "a difference of the sides",
        Element::Radius => "another rolling radius",
        Element::Track => "another effective track",
        Element::Offset => "another centre of rotation",
        Element::TurnSlip => "forward speed lost in turns",
        Element::BodyLag => "a late body",
        Element::SideRadius => "sides of different radius",
    }
}
