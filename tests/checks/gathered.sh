# Sourced. What sources include takes most of the time of reading them, so a checker reads several at once.

# gather SOURCE-FOLDER FOLDER: writes sources into FOLDER, each of which includes up to eight of one folder.
# Names in unnamed namespaces are unique within a folder of the SDK; nested builds join its sources, too.
gather() {
    local folder name
    rm -rf "$2"
    mkdir -p "$2"
    for folder in "$1"/*/; do
        name=$(basename "$folder")
        find "$folder" -name '*.cpp' | sort | awk -v into="$2/$name" '
            { print "#include \"" $0 "\"" > (into "_" int((NR - 1) / 8) ".cpp") }'
    done
}
