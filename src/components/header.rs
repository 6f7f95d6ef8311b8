//! The line on top: name, views, promise, and what concerns the whole page.

use leptos::prelude::*;

use super::icon::{Glyph, Icon};
use crate::address::{Address, View};
use crate::later::{LaterPiece, Piece};

/// The views that the line leads to.
const VIEWS: [(View, Glyph); 5] = [
    (View::Read, Glyph::Read),
    (View::Build, Glyph::Build),
    (View::Check, Glyph::Check),
    (View::Devices, Glyph::Devices),
    (View::Learn, Glyph::Learn),
];

#[component]
pub fn Header() -> impl IntoView {
    let address = expect_context::<Address>();
    let is_current =
        move |view| address.view() == view || (view == View::Read && address.view() == View::Sheet);
    let links = VIEWS.map(|(view, glyph)| {
        view! {
            <a href=format!("#/{}", view.key()) aria-current=move || is_current(view).then_some("page")>
                <Icon glyph />
                {view.label()}
            </a>
        }
    });
    view! {
        <header class="top">
            <h1>
                <svg viewBox="0 0 20 20" aria-hidden="true">
                    <path d="M2 4h16M2 9h5M2 14h4M12 8a4 4 0 1 1 0 8 4 4 0 0 1 0-8zM15 15l3 3" />
                </svg>
                "Buslens"
            </h1>
            <nav class="views" aria-label="Views">
                {links.into_iter().collect_view()}
            </nav>
            <div class="end">
                <span class="promise">
                    <Icon glyph=Glyph::Lock />
                    <span>"Nothing leaves this page"</span>
                </span>
                <LaterPiece piece=Piece::PageTools />
            </div>
        </header>
    }
}
