"""The operator's window: Qt over the same engine, stands and records as the command line.

- `command`: `tumble gui`; `start`: the application; `main_window`: the frame around the screens.
- `work`: what goes on outside the event loop, and how it is heard of inside.
- `method`: what a method brings along for the window; `registry` finds it; `methods`: the parts of each; `generic`: how
  a method is shown without any.
- `look`: colours, text size, languages, plots; `widgets`: small parts; `screens`: Stand, Run, Result, Records.

Nothing below this package knows Qt.
"""
