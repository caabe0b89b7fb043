#![doc = include_str!("../README.md")]
#![no_std]

/// One tuned number, as the page of settings shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Setting {
    /// The stage that it belongs to: a field of the crate's `Settings`.
    pub group: &'static str,
    /// What that stage does.
    pub about: &'static str,
    /// Name of the number.
    pub name: &'static str,
    /// Its value, as it is written in the source.
    pub default: &'static str,
    /// Its unit; "1" of a share, a factor or a count.
    pub unit: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// Where it comes from; "guess" is a source.
    pub source: &'static str,
}

impl Setting {
    /// Whether unit, meaning and source say anything.
    pub const fn is_documented(&self) -> bool {
        const fn says_nothing(text: &str) -> bool {
            text.trim_ascii().is_empty()
        }
        !(says_nothing(self.about)
            || says_nothing(self.unit)
            || says_nothing(self.meaning)
            || says_nothing(self.source))
    }
}

/// Declares the settings of a crate: a struct for each stage, one `Settings` that holds them all, its defaults as
/// `Settings::DEFAULT`, and a row for each number in `Settings::ALL`.
///
/// A number reads `name: type = default, "unit", "source";` below a comment that says what it means.
///
/// ```compile_fail,E0080
/// settings::settings! {
///     /// A number whose unit is blank.
///     struct Settings;
///     /// Stopping at a wall.
///     stopping: Stopping {
///         /// Distance at which the brake is applied.
///         distance: f64 = 0.5, " ", "guess";
///     }
/// }
/// ```
#[macro_export]
macro_rules! settings {
    (
        $(#[doc = $all:literal])+
        $vis:vis struct $Settings:ident;

        $(
            $(#[doc = $about:literal])+
            $group:ident: $Group:ident {
                $(
                    $(#[doc = $meaning:literal])+
                    $name:ident: $kind:ty = $default:expr, $unit:literal, $source:literal;
                )+
            }
        )+
    ) => {
        $(
            $(#[doc = $about])+
            #[derive(Debug, Clone, Copy, PartialEq)]
            $vis struct $Group {
                $(
                    $(#[doc = $meaning])+
                    #[doc = concat!("\n\nUnit: ", $unit, ". Source: ", $source, ".")]
                    $vis $name: $kind,
                )+
            }

            impl $Group {
                /// What this stage does.
                $vis const ABOUT: &'static str = concat!($($about),+);
            }
        )+

        $(#[doc = $all])+
        #[derive(Debug, Clone, Copy, PartialEq)]
        $vis struct $Settings {
            $(
                $(#[doc = $about])+
                $vis $group: $Group,
            )+
        }

        impl $Settings {
            /// Every number as it stands in the source.
            $vis const DEFAULT: Self = Self { $($group: $Group { $($name: $default),+ }),+ };

            /// A row for each number, in the order of the source.
            $vis const ALL: &'static [$crate::Setting] = &[$($($crate::Setting {
                group: stringify!($group),
                about: $Group::ABOUT,
                name: stringify!($name),
                default: stringify!($default),
                unit: $unit,
                meaning: concat!($($meaning),+),
                source: $source,
            }),+),+];
        }

        // A text of blanks compiles as little as none.
        const _: () = {
            let mut i = 0;
            while i < $Settings::ALL.len() {
                assert!($Settings::ALL[i].is_documented(), "a setting without a unit, a meaning or a source");
                i += 1;
            }
        };
    };
}
