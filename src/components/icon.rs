//! Small pictures, drawn in the colour of the text around them.

use leptos::prelude::*;

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glyph {
    Add,
    Back,
    Build,
    Check,
    ChevronDown,
    ChevronRight,
    Clock,
    Close,
    Copy,
    Devices,
    Dot,
    Down,
    Edit,
    File,
    Forward,
    Gap,
    Help,
    Hint,
    Learn,
    Link,
    Lock,
    Mail,
    More,
    Open,
    Pause,
    Play,
    Print,
    Read,
    Save,
    Search,
    Sun,
    Tick,
    Undo,
    Up,
    Warning,
}

impl Glyph {
    /// Its strokes, in a square of 16.
    const fn strokes(self) -> &'static str {
        match self {
            Self::Add => "M8 3v10M3 8h10",
            Self::Back => "m10 4-4 4 4 4",
            Self::Build => "M2 6h5v5H2zM9 6h5v5H9zM4.5 3h7M11.5 3v3M4.5 3v3",
            Self::Check => "M2 8h3l2-5 3 10 2-5h2",
            Self::ChevronDown => "m4 6 4 4 4-4",
            Self::ChevronRight | Self::Forward => "m6 4 4 4-4 4",
            Self::Clock => "M8 2a6 6 0 1 1 0 12A6 6 0 0 1 8 2zM8 4.5V8l2.5 1.5",
            Self::Close => "m4 4 8 8M12 4l-8 8",
            Self::Copy => {
                "M7 5.5h5A1.5 1.5 0 0 1 13.5 7v5a1.5 1.5 0 0 1-1.5 1.5H7A1.5 1.5 0 0 1 5.5 12V7A1.5 1.5 0 0 1 7 5.5zM10.5 \
                 3.5V3A1 1 0 0 0 9.5 2h-6a1 1 0 0 0-1 1v6a1 1 0 0 0 1 1H4"
            }
            Self::Devices => "M2 4.5h12v7H2zM5 14.5h6M5 8h2M9 8h2",
            Self::Dot => "M8 6.5a1.5 1.5 0 1 1 0 3 1.5 1.5 0 0 1 0-3z",
            Self::Down => "M8 3v10M4 9l4 4 4-4",
            Self::Edit => "m3 13 .7-3L11 2.7l2.3 2.3L6 12.3z",
            Self::File => "M4 2h5l3.5 3.5V14H4zM9 2v3.5h3.5",
            Self::Gap => "M3 8h2M7 8h2M11 8h2",
            Self::Help => {
                "M8 2a6 6 0 1 1 0 12A6 6 0 0 1 8 2zM6.3 6.3a1.8 1.8 0 1 1 2.5 1.7c-.5.3-.8.6-.8 1.2M8 11.3v.1"
            }
            Self::Hint => "M6 11.5C4.5 10.5 3.5 9 3.5 7a4.5 4.5 0 0 1 9 0c0 2-1 3.5-2.5 4.5zM6.3 14h3.4",
            Self::Learn => "M1.5 6 8 3l6.5 3L8 9zM4 7.5V11c2 2 6 2 8 0V7.5",
            Self::Link => {
                "M6.5 9.5 9.5 6.5M7.5 4.5 9 3a2.8 2.8 0 0 1 4 4l-1.5 1.5M8.5 11.5 7 13a2.8 2.8 0 0 1-4-4l1.5-1.5"
            }
            Self::Lock => "M4.5 7h7v6.5h-7zM5.5 7V5a2.5 2.5 0 0 1 5 0v2",
            Self::Mail => "M2 4h12v8.5H2zM2 4.5l6 4.5 6-4.5",
            Self::More => {
                "M3 7.5a.5.5 0 1 1 0 1 .5.5 0 0 1 0-1zM8 7.5a.5.5 0 1 1 0 1 .5.5 0 0 1 0-1zM13 7.5a.5.5 0 1 1 0 1 .5.5 0 0 \
                 1 0-1z"
            }
            Self::Open => "M8 10V2.5M5 5.5l3-3 3 3M2.5 10v3.5h11V10",
            Self::Pause => "M5.5 3.5v9M10.5 3.5v9",
            Self::Play => "M5 3.5v9l7-4.5z",
            Self::Print => "M4.5 6V2.5h7V6M4.5 11.5H2.5V6h11v5.5h-2M4.5 9.5h7v4h-7z",
            Self::Read => "M2 3.5h12M2 8h6M2 12.5h5M12 8.5a2.5 2.5 0 1 1 0 5 2.5 2.5 0 0 1 0-5z",
            Self::Save => "M8 2.5V10M5 7l3 3 3-3M2.5 13.5h11",
            Self::Search => "M7 2.5a4.5 4.5 0 1 1 0 9 4.5 4.5 0 0 1 0-9zM10.5 10.5 14 14",
            Self::Sun => {
                "M8 5a3 3 0 1 1 0 6 3 3 0 0 1 0-6zM8 1.5v1M8 13.5v1M1.5 8h1M13.5 8h1M3.4 3.4l.7.7M11.9 \
                 11.9l.7.7M3.4 12.6l.7-.7M11.9 4.1l.7-.7"
            }
            Self::Tick => "m3 8.5 3.5 3.5L13 4.5",
            Self::Undo => "M3 6h6.5a3.5 3.5 0 0 1 0 7H6M5.5 3 2.5 6l3 3",
            Self::Up => "M8 13V3M4 7l4-4 4 4",
            Self::Warning => "M8 2 14.5 13.5h-13zM8 6.5v3.5M8 12v.1",
        }
    }
}

/// A picture beside a word, or in a button that has a name of its own.
#[component]
pub fn Icon(glyph: Glyph) -> impl IntoView {
    view! {
        <svg class="icon" viewBox="0 0 16 16" aria-hidden="true">
            <path d=glyph.strokes() />
        </svg>
    }
}
