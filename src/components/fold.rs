//! What is folded away until somebody wants to know more.

use leptos::html;
use leptos::prelude::*;

/// A part under its title. Its content is made when it is first opened: where most of it stays folded, each
/// keystroke would make it anew for nobody.
#[component]
pub fn Fold(
    #[prop(into)] summary: ViewFn,
    /// Open at first.
    #[prop(optional)]
    open: bool,
    #[prop(default = "fold")] class: &'static str,
    children: ChildrenFn,
) -> impl IntoView {
    let fold = NodeRef::<html::Details>::new();
    let opened = RwSignal::new(open);
    let turned = move |_| {
        if fold.get_untracked().is_some_and(|fold| fold.open()) {
            opened.set(true);
        }
    };
    view! {
        <details class=class open=open node_ref=fold on:toggle=turned>
            <summary>{summary.run()}</summary>
            <Show when=move || opened.get()>{children()}</Show>
        </details>
    }
}
